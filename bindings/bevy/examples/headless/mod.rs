//! What the examples share: an app without a window, and its pictures.
use bevy::app::PluginGroupBuilder;
use bevy::asset::UnapprovedPathMode;
use bevy::log::{Level, LogPlugin};
use bevy::prelude::*;
use bevy::render::RenderPlugin;
use bevy::render::pipelined_rendering::PipelinedRenderingPlugin;
use bevy::render::view::window::screenshot::{Screenshot, ScreenshotCaptured};
use bevy::window::ExitCondition;
use hf_bevy::{DeformError, DeformedMesh};
use std::time::{Duration, Instant};

#[derive(Resource, Default)]
struct Picture(Option<Image>);

pub fn plugins() -> PluginGroupBuilder {
    DefaultPlugins
        .set(WindowPlugin { primary_window: None, exit_condition: ExitCondition::DontExit, ..default() })
        .set(AssetPlugin { unapproved_path_mode: UnapprovedPathMode::Allow, ..default() })
        .set(LogPlugin { level: Level::WARN, ..default() })
        .set(RenderPlugin { synchronous_pipeline_compilation: true, ..default() })
        .disable::<PipelinedRenderingPlugin>()
}

/// Waits until the deformers have their meshes.
pub fn load(app: &mut App, deformers: &[Entity], model: &str) -> Result<(), String> {
    let begin = Instant::now();
    while deformers.iter().any(|&deformer| app.world().get::<DeformedMesh>(deformer).is_none()) {
        app.update();
        if let Some(error) = deformers.iter().find_map(|&deformer| app.world().get::<DeformError>(deformer)) {
            return Err(error.0.to_string());
        }
        if begin.elapsed() > Duration::from_secs(60) {
            return Err(format!("{model} has not loaded in a minute"));
        }
    }
    Ok(())
}

/// What a camera has drawn into `image`, written into a file.
pub fn draw(app: &mut App, image: &Handle<Image>, file: &str) -> Result<Vec<[u8; 3]>, String> {
    for _ in 0..2 {
        app.update(); // a new camera needs a frame
    }
    app.world_mut().insert_resource(Picture::default());
    let keep = |captured: On<ScreenshotCaptured>, mut picture: ResMut<Picture>| picture.0 = Some(captured.image.clone());
    app.world_mut().spawn(Screenshot::image(image.clone())).observe(keep);
    for _ in 0..100 {
        app.update();
        let Some(picture) = app.world_mut().resource_mut::<Picture>().0.take() else { continue };
        let picture = picture.try_into_dynamic().map_err(|error| error.to_string())?.to_rgb8();
        if let Some(folder) = std::path::Path::new(file).parent() {
            std::fs::create_dir_all(folder).map_err(|error| format!("{file}: {error}"))?;
        }
        picture.save(file).map_err(|error| format!("{file}: {error}"))?;
        return Ok(picture.pixels().map(|pixel| pixel.0).collect());
    }
    Err(format!("{file}: the picture did not come"))
}

/// The median and the worst of each list.
pub fn say<const N: usize>(rows: [(&str, Vec<Duration>); N]) {
    for (what, mut times) in rows {
        times.sort();
        let ms = |time: Duration| 1e3 * time.as_secs_f64();
        println!("a frame: {:.1} ms {what} (worst {:.1})", ms(times[times.len() / 2]), ms(*times.last().unwrap()));
    }
}
