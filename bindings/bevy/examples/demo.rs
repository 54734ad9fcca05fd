//! demo MODEL OUT: a creature whose limbs are dragged for two seconds of 60 frames each, drawn without a window.
//!
//! MODEL: a glb or gltf file. Writes OUT_rest.png, OUT_1.png ... and says how long a frame took. Ends with 1 when a picture
//! shows nothing or a pose is wrong. With the feature `window`, `demo MODEL` shows the same in a window.
use bevy::camera::RenderTarget;
use bevy::core_pipeline::tonemapping::Tonemapping;
use bevy::gltf::GltfAssetLabel;
use bevy::prelude::*;
use bevy::render::render_resource::TextureFormat;
use bevy::render::renderer::RenderAdapterInfo;
use bevy::time::TimeUpdateStrategy;
use hf_bevy::{DeformHandle, DeformPlugin, DeformedMesh, Deformer};
use std::collections::HashSet;
use std::path::Path;
use std::time::{Duration, Instant};

mod headless;

/// two seconds at 60 Hz, and the frame of a drag that is drawn into a file
const FRAMES: u32 = 120;
const DRAWN: u32 = 45;
const BACKGROUND: [u8; 3] = [41, 43, 51];

/// The size of the creature, and the axis along its body.
#[derive(Resource, Clone, Copy)]
struct Stage {
    size: f32,
    along: Vec3,
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let done = match &arguments[..] {
        [model, out] => without_window(model, out),
        #[cfg(feature = "window")]
        [model] => window::run(model),
        _ => Err("usage: demo MODEL OUT".into()),
    };
    if let Err(why) = done {
        eprintln!("error: {why}");
        std::process::exit(1);
    }
}

/// The creature in the engine; returns its deformer.
fn stage(app: &mut App, model: &str) -> Entity {
    app.insert_resource(ClearColor(Color::srgb_u8(BACKGROUND[0], BACKGROUND[1], BACKGROUND[2]))).add_plugins(DeformPlugin);
    let file = std::path::absolute(model).unwrap_or_else(|_| model.into());
    let scene = app.world().resource::<AssetServer>().load(GltfAssetLabel::Scene(0).from_asset(file));
    app.world_mut().spawn((WorldAssetRoot(scene), Deformer::default(), Transform::default())).id()
}

/// Lights, and a camera that sees the creature from its side and draws into `target`, or into the window.
fn look(world: &mut World, deformer: Entity, target: Option<RenderTarget>) -> Stage {
    let rest = world.get::<DeformedMesh>(deformer).unwrap().rest();
    let (mut low, mut high) = (Vec3::MAX, Vec3::MIN);
    for p in rest {
        (low, high) = (low.min(Vec3::from_array(*p)), high.max(Vec3::from_array(*p)));
    }
    let (centre, size) = ((low + high) / 2.0, (high - low).length());
    let (across, along) = if high.x - low.x < high.z - low.z { (Vec3::X, Vec3::Z) } else { (Vec3::Z, Vec3::X) };
    let eye = centre - 1.35 * size * across + 0.2 * size * Vec3::Y;
    let place = Transform::from_translation(eye).looking_at(centre + 0.05 * size * Vec3::Y, Vec3::Y);
    let lens = PerspectiveProjection { near: 0.05 * size, far: 10.0 * size, ..default() };
    let mut camera = world.spawn((Camera3d::default(), Projection::Perspective(lens), Tonemapping::None, Msaa::Off, place));
    camera.insert(AmbientLight { brightness: 300.0, ..default() });
    if let Some(target) = target {
        camera.insert(target);
    }
    let above = Transform::default().looking_to(across - Vec3::Y - 0.5 * along, Vec3::Y);
    world.spawn((DirectionalLight { illuminance: 4000.0, ..default() }, above));
    Stage { size, along }
}

/// Handles that hold the body are spawned; points and radii of those worth dragging are returned.
fn propose(world: &mut World, deformer: Entity) -> hf_bevy::hf::Result<Vec<(Vec3, f32)>> {
    let proposals = world.get::<DeformedMesh>(deformer).unwrap().propose_handles()?;
    let mut tips = vec![];
    for proposal in proposals {
        let (point, radius) = (proposal.position.map(|x| x as f32).into(), proposal.radius as f32);
        match proposal.pinned {
            0 => tips.push((point, radius)),
            _ => drop(world.spawn(DeformHandle::at(deformer, point, radius))),
        }
    }
    Ok(tips)
}

/// The path of a handle: up, and once forth and back.
fn path(stage: &Stage, frame: u32) -> Vec3 {
    let t = std::f32::consts::TAU * frame as f32 / FRAMES as f32;
    stage.size * (0.16 * (t / 2.0).sin().powi(2) * Vec3::Y + 0.1 * t.sin() * stage.along)
}

fn without_window(model: &str, out: &str) -> Result<(), String> {
    if !Path::new(model).is_file() {
        return Err(format!("no file {model}"));
    }
    let mut app = App::new();
    app.add_plugins(headless::plugins());
    app.insert_resource(TimeUpdateStrategy::ManualDuration(Duration::from_secs(1) / 60));
    let deformer = stage(&mut app, model);
    app.finish();
    app.cleanup();

    headless::load(&mut app, &[deformer], model)?;
    let image = Image::new_target_texture(800, 600, TextureFormat::Rgba8UnormSrgb, None);
    let image = app.world_mut().resource_mut::<Assets<Image>>().add(image);
    let stage = look(app.world_mut(), deformer, Some(RenderTarget::Image(image.clone().into())));
    let rest = draw(&mut app, &image, &format!("{out}_rest.png"))?;
    let tips = propose(app.world_mut(), deformer).map_err(|error| error.to_string())?;
    if tips.is_empty() {
        return Err("the creature has no limb to drag".into());
    }

    let (mut pose, mut solve, mut whole) = (vec![], vec![], vec![]);
    for (k, &(point, radius)) in tips.iter().take(3).enumerate() {
        let handle = app.world_mut().spawn(DeformHandle::tip(deformer, point, radius)).id(); // while posed: no factorisation
        for frame in 0..=FRAMES {
            app.world_mut().get_mut::<Transform>(handle).unwrap().translation = point + path(&stage, frame);
            let begin = Instant::now();
            app.update();
            whole.push(begin.elapsed());
            let (all, solved) = app.world().get::<DeformedMesh>(deformer).unwrap().took();
            pose.push(all);
            solve.push(solved);
            if frame == DRAWN {
                landed(app.world(), deformer, (point, radius), path(&stage, frame), &stage)?;
                let drawn = draw(&mut app, &image, &format!("{out}_{}.png", k + 1))?;
                let changed = rest.iter().zip(&drawn).filter(|(a, b)| a != b).count();
                if changed < rest.len() / 200 {
                    return Err(format!("picture {}: {changed} pixels differ from rest", k + 1));
                }
            }
        }
        let off = landed(app.world(), deformer, (point, radius), Vec3::ZERO, &stage)?;
        println!("tip {}: back within {off:.1e} of the size", k + 1);
    }
    if let Some(adapter) = app.world().get_resource::<RenderAdapterInfo>() {
        println!("drawn by {}, {}, {}", adapter.name, adapter.driver_info, adapter.backend);
    }
    let deformed = app.world().get::<DeformedMesh>(deformer).unwrap();
    let number = deformed.meshes().count();
    let bound = deformed.surface().statistics().map_err(|error| error.to_string())?;
    let bound = bound.weld_ms + bound.operator_ms + bound.ordering_ms + bound.symbolic_ms + bound.numeric_ms + bound.links_ms;
    println!("{} vertices, {number} meshes, {} handles, bound in {bound:.0} ms", deformed.rest().len(), deformed.handle_count());
    headless::say([("to solve the pose", solve), ("to pose: solved and written", pose), ("in all, drawn", whole)]);
    Ok(())
}

/// Checks that the region of a handle is where the handle put it, and that the mesh on show has every posed vertex. The rotation
/// of a tip follows its limb, so the middle of the region counts.
fn landed(world: &World, deformer: Entity, (point, radius): (Vec3, f32), moved: Vec3, stage: &Stage) -> Result<f32, String> {
    let deformed = world.get::<DeformedMesh>(deformer).unwrap();
    if deformed.posed().iter().flatten().any(|x| !x.is_finite()) {
        return Err("a posed vertex is not finite".into());
    }
    let mut copies = HashSet::new(); // of a vertex at a seam: one counts
    let both = deformed.rest().iter().zip(deformed.posed()).filter(|(p, _)| copies.insert(p.map(f32::to_bits)));
    let both = both.map(|(p, q)| (Vec3::from_array(*p), Vec3::from_array(*q)));
    let ways: Vec<Vec3> = both.filter(|(p, _)| p.distance(point) <= radius).map(|(p, q)| q - p).collect();
    let off = (ways.iter().sum::<Vec3>() / ways.len() as f32 - moved).length() / stage.size;
    if off > 1e-4 {
        return Err(format!("a handle is {off:.1e} of the size from where it was put"));
    }
    for (entity, vertices) in deformed.meshes() {
        let shown = &world.get::<Mesh3d>(entity).unwrap().0;
        let shown = world.resource::<Assets<Mesh>>().get(shown).unwrap();
        let place = world.get::<GlobalTransform>(entity).unwrap(); // the deformer stands in the origin
        let positions = shown.attribute(Mesh::ATTRIBUTE_POSITION).unwrap().as_float3().unwrap();
        for (p, q) in positions.iter().zip(&deformed.posed()[vertices]) {
            if place.transform_point(Vec3::from_array(*p)).distance(Vec3::from_array(*q)) > 1e-5 * stage.size {
                return Err("the mesh on show is not the pose".into());
            }
        }
    }
    Ok(off)
}

/// Draws the creature as it is and writes the picture. Refuses one that shows nothing.
fn draw(app: &mut App, image: &Handle<Image>, file: &str) -> Result<Vec<[u8; 3]>, String> {
    let pixels = headless::draw(app, image, file)?;
    let (drawn, mut shades) = (pixels.iter().filter(|pixel| **pixel != BACKGROUND).count(), pixels.clone());
    shades.sort_unstable();
    shades.dedup();
    if drawn < pixels.len() / 50 || drawn > pixels.len() * 9 / 10 || shades.len() < 50 {
        return Err(format!("{file}: {drawn} of {} pixels drawn, {} colours", pixels.len(), shades.len()));
    }
    Ok(pixels)
}

#[cfg(feature = "window")]
mod window {
    use super::*;

    #[derive(Resource, Default)]
    struct Drag {
        tips: Vec<(Vec3, f32)>,
        frame: u32,
        handle: Option<Entity>,
    }

    pub(crate) fn run(model: &str) -> Result<(), String> {
        let mut app = App::new();
        app.add_plugins(DefaultPlugins.set(AssetPlugin { unapproved_path_mode: UnapprovedPathMode::Allow, ..default() }));
        let deformer = stage(&mut app, model);
        app.init_resource::<Drag>().add_systems(Update, move |world: &mut World| drag(world, deformer));
        match app.run() {
            AppExit::Success => Ok(()),
            AppExit::Error(code) => Err(format!("the engine ended with {code}")),
        }
    }

    /// One limb after the other, for ever.
    fn drag(world: &mut World, deformer: Entity) {
        if world.get::<DeformedMesh>(deformer).is_none() {
            return;
        }
        if !world.contains_resource::<Stage>() {
            let stage = look(world, deformer, None);
            world.insert_resource(stage);
            world.resource_mut::<Drag>().tips = propose(world, deformer).unwrap_or_default();
        }
        let stage = *world.resource::<Stage>();
        world.resource_scope(|world, mut drag: Mut<Drag>| {
            let Some(&(point, radius)) = drag.tips.get((drag.frame / FRAMES) as usize % drag.tips.len().max(1)) else { return };
            if drag.frame % FRAMES == 0 {
                if let Some(last) = drag.handle.take() {
                    world.despawn(last);
                }
                drag.handle = Some(world.spawn(DeformHandle::tip(deformer, point, radius)).id());
            }
            world.get_mut::<Transform>(drag.handle.unwrap()).unwrap().translation = point + path(&stage, drag.frame % FRAMES);
            drag.frame += 1;
        });
    }
}
