//! `scenes`: what is embedded.

use std::fs::{self, File};
use std::io::{BufWriter, Write};

use anyhow::Context;

use super::arguments::ScenesOptions;
use crate::scene::{embedded, obj_export};

/// Lists the embedded scenes, and writes them if asked to.
pub(super) fn run(options: &ScenesOptions) -> anyhow::Result<bool> {
    let mut out = std::io::stdout().lock();
    if let Some(folder) = &options.export {
        fs::create_dir_all(folder)
            .with_context(|| format!("making the folder {}", folder.display()))?;
    }
    for scene in embedded::all() {
        let mesh = scene.mesh();
        writeln!(
            out,
            "{:<14} {:>8} triangles  {}",
            scene.name,
            mesh.triangles.len(),
            scene.description
        )?;
        if let Some(folder) = &options.export {
            let path = folder.join(format!("{}.obj", scene.name));
            let context = || format!("writing {}", path.display());
            let mut file = BufWriter::new(File::create(&path).with_context(context)?);
            obj_export::write_obj(&mesh, &mut file).with_context(context)?;
            file.flush().with_context(context)?;
        }
    }
    Ok(true)
}
