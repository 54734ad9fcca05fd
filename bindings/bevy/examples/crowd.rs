//! crowd MODEL COUNT OUT [processor]: creatures with poses of their own, whose vertices the GPU blends, drawn without a window.
//!
//! MODEL: a glb or gltf file. Drags a limb of each creature for two seconds of 60 frames, says how long a frame takes without the
//! drawing, and writes OUT.png. With `processor` the vertices are written by the processor, to compare the two.
use bevy::camera::RenderTarget;
use bevy::core_pipeline::tonemapping::Tonemapping;
use bevy::gltf::GltfAssetLabel;
use bevy::prelude::*;
use bevy::render::render_resource::TextureFormat;
use hf_bevy::{DeformHandle, DeformPlugin, DeformSystems, DeformedMesh, Deformer, GpuBlend, GpuBlendPlugin};
use std::f32::consts::TAU;
use std::time::{Duration, Instant};

mod headless;

/// two seconds at 60 Hz
const FRAMES: u32 = 120;

/// A handle that is dragged from its place at rest.
#[derive(Component)]
struct Dragged {
    from: Vec3,
    size: f32,
    /// a share of the round
    phase: f32,
}

/// When the plugin began with this frame, and how long it took.
#[derive(Resource)]
struct Posing(Instant, Duration);

#[derive(Resource, Default)]
struct Frame(u32);

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let done = match &arguments[..] {
        [model, count, out] => crowd(model, count, out, true),
        [model, count, out, processor] if processor == "processor" => crowd(model, count, out, false),
        _ => Err("usage: crowd MODEL COUNT OUT [processor]".into()),
    };
    if let Err(why) = done {
        eprintln!("error: {why}");
        std::process::exit(1);
    }
}

fn crowd(model: &str, count: &str, out: &str, gpu: bool) -> Result<(), String> {
    let count: usize = count.parse().map_err(|_| format!("COUNT is no number: {count}"))?;
    let mut app = App::new();
    app.add_plugins((headless::plugins(), DeformPlugin, GpuBlendPlugin)).init_resource::<Frame>();
    app.insert_resource(Posing(Instant::now(), Duration::ZERO)).insert_resource(ClearColor(Color::srgb_u8(41, 43, 51)));
    app.add_systems(Update, drag).add_systems(
        PostUpdate,
        (
            (|mut posing: ResMut<Posing>| posing.0 = Instant::now()).before(DeformSystems).after(TransformSystems::Propagate),
            (|mut posing: ResMut<Posing>| posing.1 = posing.0.elapsed()).after(DeformSystems),
        ),
    );
    app.finish();
    app.cleanup();
    let file = std::path::absolute(model).map_err(|error| error.to_string())?;
    let scene = app.world().resource::<AssetServer>().load(GltfAssetLabel::Scene(0).from_asset(file));
    // small bodies on a screen: fewer rotations and clusters, and a frame goes on from the last one
    let deformer = Deformer {
        pose: hf_bevy::hf::PoseOptions { group_count: 60, band_count: 5, ..default() },
        deform: hf_bevy::hf::DeformOptions { iteration_count: 1, ..default() },
        ..default()
    };
    let creatures: Vec<Entity> =
        (0..count).map(|_| app.world_mut().spawn((WorldAssetRoot(scene.clone()), deformer, Transform::default())).id()).collect();
    if gpu {
        for &creature in &creatures {
            app.world_mut().entity_mut(creature).insert(GpuBlend);
        }
    }
    headless::load(&mut app, &creatures, model)?;
    let (camera, image) = stage(&mut app, &creatures).map_err(|error| error.to_string())?;
    app.insert_resource(Frame(0));

    let (mut solving, mut posing, mut whole) = (vec![], vec![], vec![]);
    for frame in 0..FRAMES {
        let begin = Instant::now();
        app.update();
        if frame > 5 {
            // the first frames make buffers
            whole.push(begin.elapsed());
            posing.push(app.world().resource::<Posing>().1);
            solving.push(creatures.iter().map(|&creature| app.world().get::<DeformedMesh>(creature).unwrap().took().1).sum());
        }
    }
    let first = app.world().get::<DeformedMesh>(creatures[0]).unwrap();
    let (vertices, handles) = (first.rest().len(), first.handle_count());
    let by = if gpu { "the GPU" } else { "the processor" };
    println!("{count} creatures of {vertices} vertices and {handles} handles; vertices by {by}");
    headless::say([("of solves, added up over threads", solving), ("in DeformSystems", posing), ("in all, without drawing", whole)]);
    app.world_mut().get_mut::<Camera>(camera).unwrap().is_active = true;
    headless::draw(&mut app, &image, &format!("{out}.png")).map(|_| ())
}

/// Handles, places in a square, a light, and a camera that draws nothing yet.
fn stage(app: &mut App, creatures: &[Entity]) -> hf_bevy::hf::Result<(Entity, Handle<Image>)> {
    let world = app.world_mut();
    let (mut low, mut high) = (Vec3::MAX, Vec3::MIN);
    for p in world.get::<DeformedMesh>(creatures[0]).unwrap().rest() {
        (low, high) = (low.min(Vec3::from_array(*p)), high.max(Vec3::from_array(*p)));
    }
    let (size, side) = ((high - low).length(), (creatures.len() as f32).sqrt().ceil());
    for (number, &creature) in creatures.iter().enumerate() {
        let proposals = world.get::<DeformedMesh>(creature).unwrap().propose_handles()?;
        let mut tips: Vec<Entity> = vec![];
        for proposal in proposals {
            let (point, radius) = (proposal.position.map(|x| x as f32).into(), proposal.radius as f32);
            if proposal.pinned == 1 {
                world.spawn(DeformHandle::at(creature, point, radius));
            } else {
                let phase = number as f32 / creatures.len() as f32;
                tips.push(world.spawn((DeformHandle::tip(creature, point, radius), Dragged { from: point, size, phase })).id());
            }
        }
        // one tip of each creature is dragged, another one in its neighbour
        for tip in tips.iter().enumerate().filter(|(at, _)| *at != number % tips.len()).map(|(_, tip)| *tip) {
            world.entity_mut(tip).remove::<Dragged>();
        }
        let (row, column) = ((number as f32 / side).floor(), number as f32 % side);
        *world.get_mut::<Transform>(creature).unwrap() =
            Transform::from_xyz((column - (side - 1.0) / 2.0) * size, 0.0, (row - (side - 1.0) / 2.0) * size);
    }
    let image = Image::new_target_texture(1200, 800, TextureFormat::Rgba8UnormSrgb, None);
    let image = world.resource_mut::<Assets<Image>>().add(image);
    let eye = Transform::from_translation(Vec3::new(0.5, 0.7, 0.9) * size * (side + 1.0)).looking_at(Vec3::ZERO, Vec3::Y);
    let lens = PerspectiveProjection { near: 0.05 * size, far: 10.0 * size * side, ..default() };
    let camera = (Camera3d::default(), Camera { is_active: false, ..default() }, Projection::Perspective(lens), Tonemapping::None);
    let camera =
        world.spawn((camera, RenderTarget::Image(image.clone().into()), AmbientLight { brightness: 300.0, ..default() }, eye)).id();
    let sun = Transform::default().looking_to(Vec3::new(-0.5, -1.0, -0.3), Vec3::Y);
    world.spawn((DirectionalLight { illuminance: 5000.0, shadow_maps_enabled: true, ..default() }, sun));
    Ok((camera, image))
}

/// Up, and once forth and back.
fn drag(mut frame: ResMut<Frame>, mut dragged: Query<(&Dragged, &mut Transform)>) {
    frame.0 += 1;
    for (dragged, mut place) in &mut dragged {
        let t = TAU * (frame.0 as f32 / FRAMES as f32 + dragged.phase);
        place.translation = dragged.from + dragged.size * (0.16 * (t / 2.0).sin().powi(2) * Vec3::Y + 0.1 * t.sin() * Vec3::Z);
    }
}
