//! Scenes: triangle meshes with cameras.

pub mod camera;
pub mod embedded;
pub mod mesh;
pub mod obj;
pub mod obj_export;
pub mod rotation;

use std::path::Path;

use accel_core::primitive::{MeshError, triangles_of_mesh};
use accel_core::{InvalidPrimitives, Primitive, Triangle};

use camera::Camera;
use obj::{ObjError, ObjLimits};

pub use mesh::Mesh;
use rotation::Rotation;

/// A scene ready for building.
#[derive(Clone, Debug)]
pub struct Scene {
    /// An embedded scene's name, or the file's.
    pub name: String,
    /// The embedded scene that this is, of whatever size; `None` for a file.
    pub embedded: Option<&'static str>,
    /// The last turn given to it.
    pub rotation: Rotation,
    /// The triangles; hits name them by their position here.
    pub triangles: Vec<Triangle>,
    /// A camera that sees the scene.
    pub camera: Camera,
    /// What was odd about the file, ready to print; empty if nothing was.
    pub faults: String,
}

/// Why there is no scene.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SceneError {
    /// The file can't be read as OBJ.
    #[error(transparent)]
    Obj(#[from] ObjError),
    /// Neither an embedded scene nor a file.
    #[error("`{name}` is neither a file nor an embedded scene; embedded are {known}")]
    Unknown {
        /// What was asked for.
        name: String,
        /// The embedded scenes.
        known: String,
    },
    /// An embedded scene of no or too many triangles.
    #[error("`{name}`: an embedded scene has from 1 to {MOST_TRIANGLES} triangles")]
    TriangleCount {
        /// What was asked for.
        name: String,
    },
    /// A mesh has an index without a position.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// Triangles without finite corners, and no leave to skip them.
    #[error(
        "{name}: {count} triangles have corners that are not finite numbers (the first is \
         triangle {first}); `--skip-invalid` leaves them out"
    )]
    Invalid {
        /// The scene.
        name: String,
        /// How many there are.
        count: usize,
        /// The first of them.
        first: usize,
    },
}

/// Triangles that an embedded scene may be asked for.
const MOST_TRIANGLES: usize = 20_000_000;

impl Scene {
    /// The embedded scene or OBJ file called `name`; `name@count` is the embedded
    /// scene with about so many triangles.
    ///
    /// # Errors
    /// [`SceneError`] names the scene and what is wrong with it.
    pub fn load(name: &str) -> Result<Self, SceneError> {
        let (embedded, count) = match name.split_once('@') {
            Some((name, count)) => (embedded::find(name), Some(count)),
            None => (embedded::find(name), None),
        };
        match embedded {
            Some(embedded) => Self::of_embedded(embedded, name, count),
            None => Self::of_file(name),
        }
    }

    /// Turns triangles and camera, so that the picture stays the same; the name
    /// says so. Corners may leave the range of f32.
    pub fn rotate(&mut self, rotation: Rotation) {
        for triangle in &mut self.triangles {
            let corners = triangle.vertices().map(|corner| rotation.apply(corner));
            *triangle = Triangle::from(corners);
        }
        let camera = &mut self.camera;
        for vector in [&mut camera.eye, &mut camera.look_at, &mut camera.up] {
            *vector = rotation.apply(*vector);
        }
        self.name = format!("{} rotated {rotation}", self.name);
        self.rotation = rotation;
    }

    /// How many triangles have no finite corners and are to be left out.
    ///
    /// # Errors
    /// [`SceneError::Invalid`] if there are any and `invalid` doesn't say to skip
    /// them.
    pub fn count_skipped(&self, invalid: InvalidPrimitives) -> Result<usize, SceneError> {
        let faulty = self.invalid_triangles();
        match faulty.first() {
            Some(&first) if invalid == InvalidPrimitives::Reject => Err(SceneError::Invalid {
                name: self.name.clone(),
                count: faulty.len(),
                first,
            }),
            _ => Ok(faulty.len()),
        }
    }

    /// The positions of triangles without finite corners.
    fn invalid_triangles(&self) -> Vec<usize> {
        let is_invalid = |triangle: &Triangle| !triangle.bounds().is_valid();
        let all = self.triangles.iter().enumerate();
        all.filter(|(_, triangle)| is_invalid(triangle))
            .map(|(position, _)| position)
            .collect()
    }

    fn of_embedded(
        embedded: &embedded::EmbeddedScene,
        name: &str,
        count: Option<&str>,
    ) -> Result<Self, SceneError> {
        let mesh = match count.map(str::parse) {
            None => embedded.mesh(),
            Some(Ok(count)) if (1..=MOST_TRIANGLES).contains(&count) => embedded.mesh_of(count),
            Some(_) => {
                return Err(SceneError::TriangleCount {
                    name: name.to_owned(),
                });
            }
        };
        Ok(Self {
            name: name.to_owned(),
            embedded: Some(embedded.name),
            rotation: Rotation::default(),
            triangles: triangles_of_mesh(&mesh.positions, &mesh.triangles)?,
            camera: embedded.camera(),
            faults: String::new(),
        })
    }

    fn of_file(name: &str) -> Result<Self, SceneError> {
        let path = Path::new(name);
        let looks_like_a_file = path.exists() || path.extension().is_some() || name.contains('/');
        if !looks_like_a_file {
            let known: Vec<_> = embedded::all().iter().map(|scene| scene.name).collect();
            return Err(SceneError::Unknown {
                name: name.to_owned(),
                known: known.join(", "),
            });
        }
        let bar = crate::progress::bar(&format!("reading {name}"), 1);
        let loaded = obj::load_with(path, &ObjLimits::default(), &mut |done, total| {
            bar.set_length(total);
            bar.set_position(done);
        });
        bar.finish_and_clear();
        let loaded = loaded?;
        let mesh = loaded.mesh;
        Ok(Self {
            name: path.file_stem().map_or_else(
                || name.to_owned(),
                |stem| stem.to_string_lossy().into_owned(),
            ),
            embedded: None,
            rotation: Rotation::default(),
            triangles: triangles_of_mesh(&mesh.positions, &mesh.triangles)?,
            camera: Camera::seeing(&mesh),
            faults: loaded.faults.to_string(),
        })
    }
}
