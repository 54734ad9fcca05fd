//! Vertices that the GPU blends, drawn without a window. HF_PICTURES names a folder for the pictures.
use bevy::asset::RenderAssetUsages;
use bevy::camera::RenderTarget;
use bevy::camera::primitives::Aabb;
use bevy::core_pipeline::prepass::{DeferredPrepass, DepthPrepass, MotionVectorPrepass, NormalPrepass};
use bevy::core_pipeline::tonemapping::Tonemapping;
use bevy::log::LogPlugin;
use bevy::math::{Affine3A, Vec3A};
use bevy::mesh::{Indices, PrimitiveTopology};
use bevy::pbr::DefaultOpaqueRendererMethod;
use bevy::prelude::*;
use bevy::render::RenderPlugin;
use bevy::render::pipelined_rendering::PipelinedRenderingPlugin;
use bevy::render::render_resource::{Face, TextureFormat};
use bevy::render::view::window::screenshot::{Screenshot, ScreenshotCaptured};
use bevy::window::ExitCondition;
use hf_bevy::{BlendMaterial, DeformHandle, DeformPlugin, DeformedMesh, Deformer, GpuBlend, GpuBlendPlugin, HandleLimb, HandleRotation};
use std::f32::consts::TAU;

const WIDTH: u32 = 480;
const HEIGHT: u32 = 360;
const RINGS: usize = 81;
const AROUND: usize = 40;

#[derive(Resource, Default)]
struct Picture(Option<Image>);

/// A worm along y from 0 to 2 with a seam, for an entity that stands in `space`.
fn worm(space: Affine3A) -> Mesh {
    let (mut positions, mut normals, mut uv, mut triangles) = (vec![], vec![], vec![], vec![]);
    for i in 0..RINGS {
        let t = i as f32 / (RINGS - 1) as f32;
        let (half, up) = (0.3 * (t * TAU / 2.0).sin().max(0.01).sqrt(), 2.0 * t);
        for j in 0..=AROUND {
            let a = TAU * (j % AROUND) as f32 / AROUND as f32;
            let normal = Vec3A::new(a.cos(), (2.0 * t - 1.0) * (2.0 * t - 1.0).abs(), a.sin()); // an artist's
            positions.push(space.inverse().transform_point3(Vec3::new(half * a.cos(), up, half * a.sin())).to_array());
            normals.push((space.matrix3.transpose() * normal).normalize().to_array());
            uv.push([j as f32 / AROUND as f32, t]);
        }
    }
    for i in 0..RINGS - 1 {
        for j in 0..AROUND {
            let (a, b) = ((i * (AROUND + 1) + j) as u32, ((i + 1) * (AROUND + 1) + j) as u32);
            let square = [a, b, a + 1, a + 1, b, b + 1];
            triangles.extend(if space.matrix3.determinant() > 0.0 { square } else { [a, a + 1, b, a + 1, b + 1, b] });
        }
    }
    Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::default())
        .with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, positions)
        .with_inserted_attribute(Mesh::ATTRIBUTE_NORMAL, normals)
        .with_inserted_attribute(Mesh::ATTRIBUTE_UV_0, uv)
        .with_inserted_indices(Indices::U32(triangles))
}

/// Two worms, a light with shadows and a floor. The meshes of the second one stand in a space of their own.
struct Scene {
    app: App,
    image: Handle<Image>,
    camera: Entity,
    worms: [Entity; 2],
    tips: [Entity; 2],
    /// a mesh of each worm
    meshes: [Entity; 2],
}

/// A mesh whose space is turned, stretched and moved.
fn apart() -> Transform {
    Transform::from_xyz(0.2, 0.1, -0.1).with_rotation(Quat::from_euler(EulerRot::XYZ, 0.4, -0.3, 0.9)).with_scale(Vec3::new(1.5, 0.7, -0.9))
}

impl Scene {
    fn new(deferred: bool) -> Self {
        let mut app = App::new();
        let plugins = DefaultPlugins
            .set(WindowPlugin { primary_window: None, exit_condition: ExitCondition::DontExit, ..default() })
            .disable::<LogPlugin>() // there is one for all tests
            .set(RenderPlugin { synchronous_pipeline_compilation: true, ..default() })
            .disable::<PipelinedRenderingPlugin>();
        app.add_plugins((plugins, DeformPlugin, GpuBlendPlugin)).init_resource::<Picture>().insert_resource(ClearColor(Color::BLACK));
        if deferred {
            app.insert_resource(DefaultOpaqueRendererMethod::deferred());
        }
        app.finish();
        app.cleanup();
        let image = Image::new_target_texture(WIDTH, HEIGHT, TextureFormat::Rgba8UnormSrgb, None);
        let image = app.world_mut().resource_mut::<Assets<Image>>().add(image);
        let mut materials = app.world_mut().resource_mut::<Assets<StandardMaterial>>();
        let [red, blue, grey] = [[0.9, 0.4, 0.3], [0.3, 0.5, 0.9], [0.7, 0.7, 0.7]]
            .map(|[r, g, b]| materials.add(StandardMaterial::from(Color::srgb(r, g, b))));
        // its mesh is a mirrored one
        materials.get_mut(&blue).unwrap().cull_mode = Some(Face::Front);
        let mut meshes = app.world_mut().resource_mut::<Assets<Mesh>>();
        let floor = meshes.add(Plane3d::default().mesh().size(12.0, 12.0));
        let plain = meshes.add(worm(Affine3A::IDENTITY).with_generated_tangents().unwrap());
        let moved = meshes.add(worm(apart().compute_affine()));
        let hat = meshes.add(Cuboid::new(0.3, 0.3, 0.3).mesh().build().translated_by(Vec3::Y * 2.05));
        let world = app.world_mut();
        world.spawn((Mesh3d(floor), MeshMaterial3d(grey.clone()), Transform::from_xyz(0.0, -0.6, 0.0)));
        let sun = Transform::default().looking_to(Vec3::new(-0.6, -1.0, -0.7), Vec3::Y);
        world.spawn((DirectionalLight { illuminance: 6000.0, shadow_maps_enabled: true, ..default() }, sun));
        let eye = Transform::from_xyz(0.3, 2.6, 5.0).looking_at(Vec3::new(0.0, 0.7, 0.0), Vec3::Y);
        let camera = (Camera3d::default(), Tonemapping::None, Msaa::Off, RenderTarget::Image(image.clone().into()), eye);
        let camera = world.spawn((camera, AmbientLight { brightness: 300.0, ..default() })).id();

        let first = world.spawn((Deformer::default(), Mesh3d(plain), MeshMaterial3d(red), Transform::from_xyz(-0.9, 0.0, 0.0))).id();
        let place = Transform::from_xyz(0.9, 0.0, -0.3).with_rotation(Quat::from_rotation_y(0.7));
        let second = world.spawn((Deformer::default(), place, Visibility::default())).id();
        let body = world.spawn((Mesh3d(moved), MeshMaterial3d(blue), apart(), ChildOf(second))).id();
        world.spawn((Mesh3d(hat), MeshMaterial3d(grey), ChildOf(second)));
        let tips = [first, second].map(|worm| {
            world.spawn(DeformHandle::at(worm, Vec3::ZERO, 0.3));
            world.spawn(DeformHandle::at(worm, Vec3::new(0.0, 2.0, 0.0), 0.3)).id()
        });
        let mut scene = Scene { app, image, camera, worms: [first, second], tips, meshes: [first, body] };
        scene.frames(3);
        scene
    }

    fn frames(&mut self, count: usize) {
        (0..count).for_each(|_| self.app.update());
    }

    /// The tips go on their ways to a share of them, and turn. Each worm has a pose of its own.
    fn drag(&mut self, shares: impl IntoIterator<Item = f32>) {
        for share in shares {
            for (tip, way) in self.tips.into_iter().zip([Vec3::new(-0.5, -0.5, 0.8), Vec3::new(0.7, -0.8, 0.3)]) {
                let mut transform = self.app.world_mut().get_mut::<Transform>(tip).unwrap();
                transform.translation = Vec3::Y * 2.0 + share * way;
                transform.rotation = Quat::from_rotation_x(0.8 * share);
            }
            self.frames(1);
        }
    }

    fn pull(&mut self, far: f32) {
        self.drag((1..=8).map(|frame| far * frame as f32 / 8.0));
        self.settle();
    }

    /// Frames that are not drawn, until nothing moves.
    fn settle(&mut self) {
        self.app.world_mut().get_mut::<Camera>(self.camera).unwrap().is_active = false;
        self.frames(60);
        self.app.world_mut().get_mut::<Camera>(self.camera).unwrap().is_active = true;
        self.frames(2);
    }

    fn blend(&mut self, gpu: bool) {
        for worm in self.worms {
            let mut worm = self.app.world_mut().entity_mut(worm);
            if gpu {
                worm.insert(GpuBlend)
            } else {
                worm.remove::<GpuBlend>()
            };
        }
        self.frames(3);
    }

    fn deformed(&self, worm: usize) -> &DeformedMesh {
        self.app.world().get::<DeformedMesh>(self.worms[worm]).expect("bound")
    }

    /// Positions of the mesh on show.
    fn shown(&self, worm: usize) -> Vec<[f32; 3]> {
        let handle = &self.app.world().get::<Mesh3d>(self.meshes[worm]).unwrap().0;
        let mesh = self.app.world().resource::<Assets<Mesh>>().get(handle).unwrap();
        mesh.attribute(Mesh::ATTRIBUTE_POSITION).unwrap().as_float3().unwrap().to_vec()
    }

    fn drawn_by_gpu(&self, worm: usize) -> bool {
        self.app.world().get::<MeshMaterial3d<BlendMaterial>>(self.meshes[worm]).is_some()
    }

    fn draw(&mut self, name: &str) -> Vec<[u8; 3]> {
        self.frames(2);
        self.app.world_mut().resource_mut::<Picture>().0 = None;
        let keep = |captured: On<ScreenshotCaptured>, mut picture: ResMut<Picture>| picture.0 = Some(captured.image.clone());
        self.app.world_mut().spawn(Screenshot::image(self.image.clone())).observe(keep);
        for _ in 0..100 {
            self.app.update();
            let Some(picture) = self.app.world_mut().resource_mut::<Picture>().0.take() else { continue };
            let picture = picture.try_into_dynamic().unwrap().to_rgb8();
            if let Ok(folder) = std::env::var("HF_PICTURES") {
                picture.save(format!("{folder}/{name}.png")).unwrap();
            }
            return picture.pixels().map(|pixel| pixel.0).collect();
        }
        panic!("the picture did not come");
    }
}

/// How far two pictures are apart: the mean of all channels in levels of 255, and the share of pixels that differ by more than 24.
fn apart_by(what: &str, a: &[[u8; 3]], b: &[[u8; 3]]) -> (f64, f64) {
    let levels = |(a, b): (&[u8; 3], &[u8; 3])| [0, 1, 2].map(|i| a[i].abs_diff(b[i]) as f64);
    let (mut sum, mut others) = (0.0, 0);
    for difference in a.iter().zip(b).map(levels) {
        sum += difference.iter().sum::<f64>();
        others += usize::from(difference.iter().any(|level| *level > 24.0));
    }
    let (mean, share) = (sum / (3 * a.len()) as f64, others as f64 / a.len() as f64);
    println!("{what}: {mean:.4} levels in the mean, {:.4} % of the pixels differ by more than 24", 100.0 * share);
    (mean, share)
}

/// Normals of a shader are derivatives, and those of the processor means over triangles; so shades differ by some levels.
#[track_caller]
fn same(what: &str, a: &[[u8; 3]], b: &[[u8; 3]]) {
    let (mean, share) = apart_by(what, a, b);
    assert!(mean < 0.15 && share < 5e-4, "{what}: {mean} levels, {share} of the pixels");
}

#[track_caller]
fn near(what: &str, a: &[[f32; 3]], b: &[[f32; 3]], tolerance: f32) {
    assert_eq!(a.len(), b.len());
    let far = a.iter().zip(b).map(|(a, b)| Vec3::from_array(*a).distance(Vec3::from_array(*b))).fold(0.0, f32::max);
    println!("{what}: {far:.1e} apart");
    assert!(far <= tolerance, "{what}: {far} apart");
}

#[test]
fn the_gpu_draws_what_the_processor_draws() {
    let mut scene = Scene::new(false);
    let rest = scene.draw("rest");
    scene.pull(1.0);
    let wanted = scene.draw("cpu");
    let (mean, share) = apart_by("pose and rest", &wanted, &rest);
    assert!(mean > 2.0 && share > 0.05, "the pose is seen");

    let camera = scene.camera;
    scene.app.world_mut().entity_mut(camera).insert((DepthPrepass, NormalPrepass, MotionVectorPrepass));
    let wanted_after_prepass = scene.draw("cpu_prepass");
    scene.blend(true);
    assert!(scene.drawn_by_gpu(0) && scene.drawn_by_gpu(1));
    same("GPU and processor, with prepasses", &scene.draw("gpu_prepass"), &wanted_after_prepass);
    scene.app.world_mut().entity_mut(camera).remove::<(DepthPrepass, NormalPrepass, MotionVectorPrepass)>();
    same("GPU and processor", &scene.draw("gpu"), &wanted);

    // a new pose, drawn by the GPU alone, with a handle more; then the processor takes over
    let middle = DeformHandle::at(scene.worms[0], Vec3::new(0.3, 1.0, 0.0), 0.2);
    scene.app.world_mut().spawn(middle);
    scene.pull(-0.6);
    let drawn = scene.draw("gpu_other");
    assert!(apart_by("other pose", &drawn, &wanted).0 > 2.0, "the pose is seen");
    scene.blend(false);
    assert!(!scene.drawn_by_gpu(0) && !scene.drawn_by_gpu(1));
    same("processor and GPU, another pose", &scene.draw("cpu_other"), &drawn);
}

#[test]
fn a_rotation_that_was_just_freed_is_drawn_with_its_offset() {
    let (mut processor, mut gpu) = (Scene::new(false), Scene::new(false));
    gpu.blend(true);
    for scene in [&mut processor, &mut gpu] {
        // both worms are pulled far, and then their tips are freed
        scene.pull(1.0);
        for tip in scene.tips {
            scene.app.world_mut().entity_mut(tip).insert(HandleRotation::Free);
        }
        scene.settle();
        scene.drag([1.02]);
    }
    // normals leave the offset out; without it in the positions the picture is off by 0.9 levels and 1.3 % of the pixels
    let (mean, share) = apart_by("a fading offset", &gpu.draw("gpu_offset"), &processor.draw("cpu_offset"));
    assert!(mean < 0.3 && share < 3e-3, "{mean} levels, {share} of the pixels");
}

#[test]
fn deferred_shading_draws_the_same() {
    let mut scene = Scene::new(true);
    let camera = scene.camera;
    scene.app.world_mut().entity_mut(camera).insert((DepthPrepass, DeferredPrepass));
    scene.pull(1.0);
    let wanted = scene.draw("cpu_deferred");
    scene.blend(true);
    same("GPU and processor, deferred", &scene.draw("gpu_deferred"), &wanted);
}

#[test]
fn the_meshes_stay_at_rest_and_the_positions_are_those_of_the_library() {
    let mut scene = Scene::new(false);
    scene.blend(true);
    let rest = [scene.shown(0), scene.shown(1)];
    scene.pull(1.0);
    for worm in [0, 1] {
        near("mesh and rest", &scene.shown(worm), &rest[worm], 0.0);
        near("posed and rest", scene.deformed(worm).posed(), scene.deformed(worm).rest(), 1e-6);
        let root = scene.worms[worm];
        scene.app.world_mut().get_mut::<DeformedMesh>(root).unwrap().blend_posed().unwrap();
    }
    let blended = [0, 1].map(|worm| scene.deformed(worm).posed().to_vec());
    let bounds = scene.meshes.map(|mesh| *scene.app.world().get::<Aabb>(mesh).unwrap());
    scene.blend(false);
    for worm in [0, 1] {
        near("blend and library", &blended[worm], scene.deformed(worm).posed(), 2e-5);
        // every vertex is in the box by which the mesh is culled, which is no larger than twice the mesh
        let (mut low, mut high) = (Vec3::MAX, Vec3::MIN);
        for p in scene.shown(worm).into_iter().map(Vec3::from_array) {
            (low, high) = (low.min(p), high.max(p));
            let out = (p - Vec3::from(bounds[worm].center)).abs() - Vec3::from(bounds[worm].half_extents);
            assert!(out.max_element() < 1e-5, "{out}");
        }
        let (size, tight) = (2.0 * bounds[worm].half_extents.length(), (high - low).length());
        println!("the box is {:.2} times as long as the mesh", size / tight);
        assert!(size < 3.0 * tight);
    }
}

#[test]
fn a_pose_that_is_no_blend_is_written_by_the_processor() {
    let mut scene = Scene::new(false);
    scene.blend(true);
    scene.pull(0.5);
    let (rest, drawn) = (scene.shown(0), scene.draw("blend"));
    // limbs that keep their lengths need the surface
    let tip = scene.tips[0];
    let limb = *scene.app.world().get::<HandleLimb>(tip).unwrap();
    scene.app.world_mut().entity_mut(tip).insert(HandleLimb { keep_lengths: true, ..limb });
    scene.settle();
    assert_ne!(scene.shown(0), rest, "the processor writes the mesh");
    let kept = scene.draw("kept");
    scene.blend(false);
    same("kept lengths", &scene.draw("kept_cpu"), &kept);
    scene.blend(true);
    scene.app.world_mut().entity_mut(tip).insert(limb);
    scene.settle();
    near("mesh and rest", &scene.shown(0), &rest, 0.0);
    same("blended again", &scene.draw("blend_again"), &drawn);
    // without handles it is at rest, and another material is taken over
    let world = scene.app.world_mut();
    let white = world.resource_mut::<Assets<StandardMaterial>>().add(StandardMaterial::from(Color::WHITE));
    world.entity_mut(scene.meshes[0]).insert(MeshMaterial3d(white.clone()));
    let handles: Vec<Entity> = world.query_filtered::<Entity, With<DeformHandle>>().iter(world).collect();
    for handle in handles {
        world.despawn(handle);
    }
    scene.frames(3);
    let at_rest = scene.draw("no_handles");
    assert!(scene.app.world().get::<MeshMaterial3d<StandardMaterial>>(scene.meshes[0]).is_none());
    for worm in scene.worms {
        scene.app.world_mut().entity_mut(worm).remove::<Deformer>();
    }
    scene.frames(3);
    same("the meshes that were there before", &scene.draw("no_deformer"), &at_rest);
    assert!(!scene.drawn_by_gpu(0) && !scene.drawn_by_gpu(1));
    assert_eq!(scene.app.world().get::<MeshMaterial3d<StandardMaterial>>(scene.meshes[0]).unwrap().0, white);
}
