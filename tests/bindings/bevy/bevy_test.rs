//! The Bevy layer without a window and without a renderer: assets, transforms and the plugin.
use bevy::asset::{AssetPlugin, RenderAssetUsages};
use bevy::math::DVec3;
use bevy::mesh::skinning::{SkinnedMesh, SkinnedMeshInverseBindposes};
use bevy::mesh::{Indices, PrimitiveTopology, VertexAttributeValues};
use bevy::prelude::*;
use hf_bevy::{
    DeformError, DeformHandle, DeformPlugin, DeformedMesh, Deformer, HandleLimb, HandleRotation, Retarget, RetargetPlugin, Retargeted,
};
use std::f32::consts::TAU;

const RINGS: usize = 41;
const AROUND: usize = 16;

fn app() -> App {
    let mut app = App::new();
    app.add_plugins((MinimalPlugins, AssetPlugin::default(), TransformPlugin, DeformPlugin, RetargetPlugin));
    app.init_asset::<Mesh>().init_asset::<SkinnedMeshInverseBindposes>();
    app.finish();
    app.cleanup();
    app
}

/// A tube along y from 0 to 2 with a seam: the first column of vertices is there twice. Positions, normals, colours, uv.
fn tube() -> Mesh {
    let (mut positions, mut normals, mut colours, mut uv, mut triangles) = (vec![], vec![], vec![], vec![], vec![]);
    for i in 0..RINGS {
        for j in 0..=AROUND {
            let a = TAU * (j % AROUND) as f32 / AROUND as f32;
            positions.push([0.3 * a.cos(), 2.0 * i as f32 / (RINGS - 1) as f32, 0.3 * a.sin()]);
            normals.push([a.cos(), 0.0, a.sin()]);
            colours.push([1.0, i as f32 / RINGS as f32, 0.0, 1.0]);
            uv.push([j as f32 / AROUND as f32, i as f32 / RINGS as f32]);
        }
    }
    for i in 0..RINGS - 1 {
        for j in 0..AROUND {
            let (a, b) = ((i * (AROUND + 1) + j) as u16, ((i + 1) * (AROUND + 1) + j) as u16);
            triangles.extend([a, b, a + 1, a + 1, b, b + 1]);
        }
    }
    Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::default())
        .with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, positions)
        .with_inserted_attribute(Mesh::ATTRIBUTE_NORMAL, normals)
        .with_inserted_attribute(Mesh::ATTRIBUTE_COLOR, colours)
        .with_inserted_attribute(Mesh::ATTRIBUTE_UV_0, uv)
        .with_inserted_indices(Indices::U16(triangles))
}

fn add(app: &mut App, mesh: Mesh) -> Handle<Mesh> {
    app.world_mut().resource_mut::<Assets<Mesh>>().add(mesh)
}

fn shown(app: &App, entity: Entity) -> &Mesh {
    let handle = &app.world().get::<Mesh3d>(entity).unwrap().0;
    app.world().resource::<Assets<Mesh>>().get(handle).unwrap()
}

fn rows(mesh: &Mesh, normals: bool) -> &[[f32; 3]] {
    mesh.attribute(if normals { Mesh::ATTRIBUTE_NORMAL } else { Mesh::ATTRIBUTE_POSITION }).unwrap().as_float3().unwrap()
}

fn deformed(app: &App, entity: Entity) -> &DeformedMesh {
    app.world().get::<DeformedMesh>(entity).expect("bound")
}

fn handle(app: &mut App, deformer: Entity, point: [f32; 3]) -> Entity {
    app.world_mut().spawn((DeformHandle::at(deformer, point.into(), 0.4), HandleRotation::Given)).id()
}

fn place(app: &mut App, entity: Entity, transform: Transform) {
    *app.world_mut().get_mut::<Transform>(entity).unwrap() = transform;
}

/// Frames until nothing moves.
fn settle(app: &mut App) {
    (0..40).for_each(|_| app.update());
}

fn error(app: &App, entity: Entity) -> Option<&'static str> {
    app.world().get::<DeformError>(entity).map(|error| error.0.name())
}

#[track_caller]
fn near(a: &[[f32; 3]], b: &[[f32; 3]], tolerance: f32) {
    assert_eq!(a.len(), b.len());
    let far = a.iter().zip(b).map(|(a, b)| Vec3::from_array(*a).distance(Vec3::from_array(*b))).fold(0.0, f32::max);
    assert!(far <= tolerance, "{far} apart");
}

/// One tube with handles at its ends.
fn held_tube(app: &mut App) -> (Entity, Entity, Entity) {
    let mesh = add(app, tube());
    let body = app.world_mut().spawn((Deformer::default(), Mesh3d(mesh))).id();
    let (foot, tip) = (handle(app, body, [0.0, 0.0, 0.0]), handle(app, body, [0.0, 2.0, 0.0]));
    app.update();
    (body, foot, tip)
}

#[test]
fn regions_move_rigidly_with_their_entities() {
    let mut app = app();
    let (body, _, tip) = held_tube(&mut app);
    let rest = deformed(&app, body).rest().to_vec();
    near(rows(shown(&app, body), false), &rest, 1e-5);
    let moved = Transform::from_xyz(1.0, 1.7, 0.2).with_rotation(Quat::from_rotation_z(-0.9));
    place(&mut app, tip, moved);
    settle(&mut app);
    let wanted: Vec<[f32; 3]> = rest
        .iter()
        .map(|p| match p[1] {
            y if y > 1.8 => moved.transform_point(Vec3::from_array(*p) - Vec3::new(0.0, 2.0, 0.0)).to_array(),
            _ => *p,
        })
        .collect();
    let posed = rows(shown(&app, body), false);
    let ends = |rows: &[[f32; 3]]| rows.iter().zip(&rest).filter(|(_, p)| p[1] < 0.2 || p[1] > 1.8).map(|(q, _)| *q).collect::<Vec<_>>();
    near(&ends(posed), &ends(&wanted), 1e-4);
    // the middle follows, not at rest and not beyond
    let middle = Vec3::from_array(posed[RINGS / 2 * (AROUND + 1)]);
    assert!(middle.x > 0.35 && middle.x < 1.3, "{middle}");
    // what the mesh has beside positions and normals is as it was
    let original = tube();
    for attribute in [Mesh::ATTRIBUTE_COLOR, Mesh::ATTRIBUTE_UV_0] {
        assert_eq!(shown(&app, body).attribute(attribute.id), original.attribute(attribute.id));
    }
    assert_eq!(shown(&app, body).indices(), original.indices());
}

#[test]
fn a_move_frees_the_rotation_and_a_turn_gives_it_from_where_the_region_stands() {
    let mut app = app();
    let (body, foot, tip) = held_tube(&mut app);
    for entity in [foot, tip] {
        app.world_mut().entity_mut(entity).insert(HandleRotation::Automatic);
    }
    let rest = deformed(&app, body).rest().to_vec();
    // the axis of the upper cap: one across the tube at its end
    let across = |app: &App| {
        let rows = rows(shown(app, body), false);
        let (a, b) = ((RINGS - 1) * (AROUND + 1), (RINGS - 1) * (AROUND + 1) + AROUND / 2);
        (Vec3::from_array(rows[a]) - Vec3::from_array(rows[b])).normalize()
    };
    place(&mut app, tip, Transform::from_xyz(1.0, 1.7, 0.0));
    settle(&mut app);
    let leans = across(&app);
    assert!(leans.angle_between(Vec3::X) > 0.2, "{leans}");
    let bottom = |rows: &[[f32; 3]]| rows[..AROUND + 1].to_vec();
    near(&bottom(rows(shown(&app, body), false)), &bottom(&rest), 1e-4);
    let stands = rows(shown(&app, body), false).to_vec();
    place(&mut app, tip, Transform::from_xyz(1.0, 1.7, 0.0).with_rotation(Quat::from_rotation_z(0.01)));
    settle(&mut app);
    near(rows(shown(&app, body), false), &stands, 0.03);
    assert!((across(&app).angle_between(leans) - 0.01).abs() < 2e-3);
    // from then on the entity gives it, until it is freed
    place(&mut app, tip, Transform::from_xyz(0.5, 1.9, 0.0).with_rotation(Quat::from_rotation_z(0.01)));
    settle(&mut app);
    assert!((across(&app).angle_between(leans) - 0.01).abs() < 2e-3);
    app.world_mut().entity_mut(tip).insert(HandleRotation::Free);
    place(&mut app, tip, Transform::from_xyz(0.0, 2.0, 0.0));
    settle(&mut app);
    assert!(across(&app).angle_between(leans) > 0.1);
}

#[test]
fn vertices_of_a_seam_stay_together_and_share_a_normal() {
    let mut app = app();
    let (body, _, tip) = held_tube(&mut app);
    place(&mut app, tip, Transform::from_xyz(0.8, 1.8, 0.5).with_rotation(Quat::from_rotation_y(2.0)));
    settle(&mut app);
    for i in 0..RINGS {
        let (a, b) = (i * (AROUND + 1), i * (AROUND + 1) + AROUND);
        for normals in [false, true] {
            let rows = rows(shown(&app, body), normals);
            assert_eq!(rows[a], rows[b]);
        }
    }
}

#[test]
fn normals_are_unit_and_point_out_of_the_posed_surface() {
    let mut app = app();
    let (body, _, tip) = held_tube(&mut app);
    place(&mut app, tip, Transform::from_xyz(1.0, 1.7, 0.0).with_rotation(Quat::from_rotation_z(-1.2)));
    settle(&mut app);
    let (positions, normals) = (rows(shown(&app, body), false), rows(shown(&app, body), true));
    for i in 0..RINGS {
        let ring = i * (AROUND + 1)..i * (AROUND + 1) + AROUND;
        let centre = positions[ring.clone()].iter().map(|p| Vec3::from_array(*p)).sum::<Vec3>() / AROUND as f32;
        for v in ring {
            let (p, n) = (Vec3::from_array(positions[v]), Vec3::from_array(normals[v]));
            assert!((n.length() - 1.0).abs() < 1e-4);
            assert!(n.dot((p - centre).normalize()) > 0.8, "ring {i}: {n}");
        }
    }
}

#[test]
fn hard_edges_stay_hard_and_tangents_turn_with_the_surface() {
    let mut app = app();
    // flat triangles, each with normals of its own, and tangents up the tube
    let mut flat = tube();
    flat.duplicate_vertices();
    flat.compute_flat_normals();
    let count = flat.count_vertices();
    flat.insert_attribute(Mesh::ATTRIBUTE_TANGENT, vec![[0.0f32, 1.0, 0.0, -1.0]; count]);
    let authored = rows(&flat, true).to_vec();
    let mesh = add(&mut app, flat);
    let body = app.world_mut().spawn((Deformer::default(), Mesh3d(mesh))).id();
    let (_, tip) = (handle(&mut app, body, [0.0, 0.0, 0.0]), handle(&mut app, body, [0.0, 2.0, 0.0]));
    app.update();
    near(rows(shown(&app, body), true), &authored, 1e-5);
    // a turn about the axis and a bend: on the region all is rigid
    let turn = Quat::from_rotation_z(-0.7) * Quat::from_rotation_y(1.0);
    place(&mut app, tip, Transform::from_xyz(0.5, 1.8, 0.0).with_rotation(turn));
    settle(&mut app);
    let VertexAttributeValues::Float32x4(tangents) = shown(&app, body).attribute(Mesh::ATTRIBUTE_TANGENT).unwrap() else { panic!() };
    let (positions, normals) = (rows(shown(&app, body), false), rows(shown(&app, body), true));
    for (at, rest) in deformed(&app, body).rest().iter().enumerate() {
        let (n, t) = (Vec3::from_array(normals[at]), Vec3::from_slice(&tangents[at]));
        if rest[1] > 1.85 {
            assert!(n.distance(turn * Vec3::from_array(authored[at])) < 1e-3, "{at}: {n}");
            assert!(t.distance(turn * Vec3::Y) < 1e-3, "{at}: {t}");
        }
        assert!(tangents[at][3] == -1.0 && n.dot(t).abs() < 0.1);
        // elsewhere a normal is that of its posed triangle, nearly
        let [a, b, c] = [0, 1, 2].map(|corner| Vec3::from_array(positions[at / 3 * 3 + corner]));
        assert!(n.dot((b - a).cross(c - a).normalize()) > 0.97, "{at}");
    }
    app.world_mut().entity_mut(body).remove::<Deformer>();
    app.update();
}

#[test]
fn meshes_below_a_deformer_are_one_surface() {
    let mut app = app();
    let mesh = add(&mut app, tube());
    // the upper piece has its own place, turn and scale, and shares the mesh; it almost touches: a link joins them
    let stands = Transform::from_xyz(0.0, 2.01, 0.0).with_rotation(Quat::from_rotation_y(0.3)).with_scale(Vec3::new(1.0, 0.5, 0.8));
    let body = app.world_mut().spawn((Deformer::default(), Transform::from_xyz(100.0, 0.0, 7.0))).id();
    app.world_mut().spawn((Mesh3d(mesh.clone()), ChildOf(body)));
    let upper = app.world_mut().spawn((Mesh3d(mesh.clone()), stands, ChildOf(body))).id();
    let apart = app.world_mut().spawn(Mesh3d(mesh.clone())).id();
    let (_, tip) = (handle(&mut app, body, [0.0, 0.0, 0.0]), handle(&mut app, body, [0.0, 3.01, 0.0]));
    // a marker on a handle is no part of the surface
    app.world_mut().entity_mut(tip).insert(Mesh3d(mesh.clone()));
    app.update();
    let rest = deformed(&app, body).rest().to_vec();
    assert_eq!(rest.len(), 2 * RINGS * (AROUND + 1));
    near(rows(shown(&app, upper), false), rows(&tube(), false), 1e-5);
    near(rows(shown(&app, upper), true), rows(&tube(), true), 1e-5);
    place(&mut app, tip, Transform::from_xyz(0.9, 2.8, 0.0));
    settle(&mut app);
    let deformed = deformed(&app, body);
    for (entity, vertices) in deformed.meshes() {
        let stands = if entity == upper { stands } else { Transform::IDENTITY };
        let seen: Vec<_> =
            rows(shown(&app, entity), false).iter().map(|p| stands.transform_point(Vec3::from_array(*p)).to_array()).collect();
        near(&seen, &deformed.posed()[vertices], 1e-5);
    }
    let top = deformed.posed().iter().map(|p| p[0]).fold(f32::MIN, f32::max);
    assert!(top > 1.1, "{top}");
    // the pieces stay together: each vertex of the lower rim of one keeps its distance from the upper rim of the other
    let (rim, ring) = ((RINGS - 1) * (AROUND + 1), AROUND + 1);
    let gap = |rows: &[[f32; 3]]| -> f32 {
        let far = |p: &[f32; 3], q: &[f32; 3]| Vec3::from_array(*p).distance(Vec3::from_array(*q));
        let nearest = |p: &[f32; 3]| rows[rim..][..ring].iter().map(|q| far(p, q)).fold(f32::MAX, f32::min);
        rows[rim + ring..][..ring].iter().map(nearest).fold(0.0, f32::max)
    };
    assert!(gap(deformed.posed()) < gap(&rest) + 0.05, "{} and {} at rest", gap(deformed.posed()), gap(&rest));
    // others that show the mesh do not move
    assert_eq!(rows(shown(&app, apart), false), rows(&tube(), false));
}

#[test]
fn a_mirrored_mesh_has_its_normals_outside() {
    let mut app = app();
    let mesh = add(&mut app, tube());
    let body = app.world_mut().spawn(Deformer::default()).id();
    let part = app.world_mut().spawn((Mesh3d(mesh), Transform::from_scale(Vec3::new(-1.0, 1.0, 1.0)), ChildOf(body))).id();
    let (_, tip) = (handle(&mut app, body, [0.0, 0.0, 0.0]), handle(&mut app, body, [0.0, 2.0, 0.0]));
    app.update();
    near(rows(shown(&app, part), true), rows(&tube(), true), 1e-5);
    place(&mut app, tip, Transform::from_xyz(0.5, 2.0, 0.0));
    settle(&mut app);
    near(&rows(shown(&app, part), false)[(RINGS - 1) * (AROUND + 1)..][..1], &[[-0.2, 2.0, 0.0]], 1e-4);
}

#[test]
fn deformers_that_show_one_mesh_have_poses_of_their_own() {
    let mut app = app();
    let mesh = add(&mut app, tube());
    let bodies =
        [0.0, 5.0].map(|x| app.world_mut().spawn((Deformer::default(), Transform::from_xyz(x, 0.0, 0.0), Mesh3d(mesh.clone()))).id());
    let tips = bodies.map(|body| {
        handle(&mut app, body, [0.0, 0.0, 0.0]);
        handle(&mut app, body, [0.0, 2.0, 0.0])
    });
    app.update();
    place(&mut app, tips[0], Transform::from_xyz(1.0, 2.0, 0.0));
    place(&mut app, tips[1], Transform::from_xyz(-1.0, 2.0, 0.0));
    settle(&mut app);
    let [right, left] = bodies.map(|body| rows(shown(&app, body), false)[(RINGS - 1) * (AROUND + 1)]);
    near(&[right, left], &[[1.3, 2.0, 0.0], [-0.7, 2.0, 0.0]], 1e-4);
    assert_eq!(rows(app.world().resource::<Assets<Mesh>>().get(&mesh).unwrap(), false), rows(&tube(), false));
}

#[test]
fn handles_come_and_go_while_posed() {
    let mut app = app();
    let (body, foot, tip) = held_tube(&mut app);
    place(&mut app, tip, Transform::from_xyz(0.8, 1.9, 0.0));
    settle(&mut app);
    let posed = deformed(&app, body).posed().to_vec();
    let middle = handle(&mut app, body, [0.0, 1.0, 0.0]);
    app.update();
    assert_eq!(deformed(&app, body).handle_count(), 3);
    assert!(deformed(&app, body).centroid(middle).unwrap().distance(Vec3::Y) < 0.1);
    place(&mut app, middle, Transform::from_xyz(0.0, 1.0, 0.5));
    settle(&mut app);
    let at = RINGS / 2 * (AROUND + 1);
    near(&deformed(&app, body).posed()[at..=at], &[[0.3, 1.0, 0.5]], 1e-4);
    app.world_mut().despawn(middle);
    settle(&mut app);
    assert_eq!(deformed(&app, body).handle_count(), 2);
    near(deformed(&app, body).posed(), &posed, 0.02);
    // without handles the mesh is as it was, to the bit
    app.world_mut().despawn(tip);
    app.world_mut().entity_mut(foot).remove::<DeformHandle>();
    app.update();
    assert_eq!(deformed(&app, body).handle_count(), 0);
    for normals in [false, true] {
        assert_eq!(rows(shown(&app, body), normals), rows(&tube(), normals));
    }
}

#[test]
fn stiffness_and_links_change_while_posed() {
    let mut app = app();
    let mesh = add(&mut app, tube());
    let body = app.world_mut().spawn((Deformer { links: None, ..default() }, Mesh3d(mesh.clone()))).id();
    // a ring that nothing holds, at the tip
    let ring = Transform::from_xyz(0.0, 2.05, 0.0).with_scale(Vec3::new(1.0, 0.1, 1.0));
    app.world_mut().spawn((Mesh3d(mesh), ring, ChildOf(body)));
    handle(&mut app, body, [0.0, 0.0, 0.0]);
    let tip = handle(&mut app, body, [0.0, 2.0, 0.0]);
    app.update();
    place(&mut app, tip, Transform::from_xyz(1.0, 1.7, 0.0).with_rotation(Quat::from_rotation_z(-0.9)));
    settle(&mut app);
    let (rest, posed) = (deformed(&app, body).rest().to_vec(), deformed(&app, body).posed().to_vec());
    let edit = |app: &mut App, edit: &hf_bevy::hf::SurfaceEdit| {
        let done = app.world_mut().get_mut::<DeformedMesh>(body).unwrap().edit(edit);
        settle(app);
        done
    };
    // a rigid belt keeps the distance of its ends
    let at = |row: usize| row * (AROUND + 1);
    let belt: Vec<u32> = (at(15) as u32..at(26) as u32).collect();
    let strain = |rows: &[[f32; 3]]| {
        let length = |rows: &[[f32; 3]]| Vec3::from_array(rows[at(15)]).distance(Vec3::from_array(rows[at(25)]));
        (length(rows) / length(&rest) - 1.0).abs()
    };
    assert!(strain(&posed) > 0.02, "{}", strain(&posed));
    edit(&mut app, &hf_bevy::hf::SurfaceEdit { vertices: Some(&belt), stiffness: Some(&vec![1e4; belt.len()]), ..default() }).unwrap();
    assert!(strain(deformed(&app, body).posed()) < 2e-3, "{}", strain(deformed(&app, body).posed()));
    assert_eq!(deformed(&app, body).handle_count(), 2);
    edit(&mut app, &hf_bevy::hf::SurfaceEdit { vertices: Some(&belt), stiffness: Some(&vec![1.0; belt.len()]), ..default() }).unwrap();
    near(&deformed(&app, body).posed()[..at(RINGS)], &posed[..at(RINGS)], 0.02);
    // a link takes the ring along
    let moves = |app: &App| Vec3::from_array(deformed(app, body).posed()[at(RINGS)]).distance(Vec3::from_array(rest[at(RINGS)]));
    assert!(moves(&app) < 1e-5, "{}", moves(&app));
    let mut link = hf_bevy::hf::raw::hf_link { vertex: at(RINGS) as u32, weight: 1.0, ..default() };
    (link.corners, link.barycentrics) = ([at(RINGS - 1) as u32, u32::MAX, u32::MAX], [1.0, 0.0, 0.0]);
    edit(&mut app, &hf_bevy::hf::SurfaceEdit { links: Some(&[link]), ..default() }).unwrap();
    assert!(moves(&app) > 0.5, "{}", moves(&app));
    // what is refused changes nothing
    let stood = deformed(&app, body).posed().to_vec();
    let patch = hf_bevy::hf::Patch { removed_triangles: Some(&[0]), ..default() };
    let refused = edit(&mut app, &hf_bevy::hf::SurfaceEdit { patch: Some(patch), ..default() }).unwrap_err();
    assert_eq!((refused.name(), deformed(&app, body).posed()), ("HF_ERROR_UNSUPPORTED", &stood[..]));
}

#[test]
fn a_handle_is_a_child_of_anything() {
    let mut app = app();
    let (body, _, tip) = held_tube(&mut app);
    place(&mut app, body, Transform::from_xyz(0.0, 0.0, 30.0).with_rotation(Quat::from_rotation_y(1.0)).with_scale(Vec3::splat(2.0)));
    // where the deformer takes its point (1, 2, 0), with the turn of the deformer
    let world = app.world().get::<Transform>(body).unwrap().transform_point(Vec3::new(1.0, 2.0, 0.0));
    let hand = app.world_mut().spawn(Transform::from_translation(world - Vec3::X)).id();
    app.world_mut().entity_mut(tip).insert((ChildOf(hand), Transform::from_xyz(1.0, 0.0, 0.0).with_rotation(Quat::from_rotation_y(1.0))));
    settle(&mut app);
    let at = (RINGS - 1) * (AROUND + 1);
    near(&rows(shown(&app, body), false)[at..=at], &[[1.3, 2.0, 0.0]], 1e-4);
}

#[test]
fn a_deformer_far_from_the_origin_is_as_exact() {
    let mut app = app();
    let (body, _, tip) = held_tube(&mut app);
    place(&mut app, body, Transform::from_xyz(1e6, 0.0, 0.0).with_rotation(Quat::from_rotation_y(1.0)));
    place(&mut app, tip, Transform::from_xyz(0.25, 2.0, 0.0));
    settle(&mut app);
    let at = (RINGS - 1) * (AROUND + 1);
    near(&rows(shown(&app, body), false)[at..=at], &[[0.55, 2.0, 0.0]], 1e-5);
}

#[test]
fn a_refused_handle_says_why_and_is_taken_when_there_is_room() {
    let mut app = app();
    let (body, _, tip) = held_tube(&mut app);
    let over = handle(&mut app, body, [0.0, 1.9, 0.0]);
    app.update();
    app.update();
    assert_eq!(error(&app, over), Some("HF_ERROR_CONFLICT"));
    assert_eq!((error(&app, tip), deformed(&app, body).handle_count()), (None, 2));
    app.world_mut().despawn(tip);
    app.update();
    app.update();
    assert_eq!((error(&app, over), deformed(&app, body).handle_count()), (None, 2));
    // a handle that is another now
    app.world_mut().get_mut::<DeformHandle>(over).unwrap().point.y = 1.0;
    app.update();
    assert!((deformed(&app, body).centroid(over).unwrap().y - 1.0).abs() < 0.1);
    // a handle that stands nowhere holds, and the others move
    place(&mut app, over, Transform::from_xyz(f32::NAN, 1.0, 0.0));
    app.update();
    app.update();
    assert_eq!(error(&app, over), Some("HF_ERROR_NON_FINITE"));
    assert!(deformed(&app, body).posed().iter().flatten().all(|x| x.is_finite()));
    place(&mut app, over, Transform::from_xyz(0.0, 1.2, 0.0));
    app.update();
    app.update();
    assert_eq!(error(&app, over), None);
}

#[test]
fn a_surface_that_rests_is_not_written() {
    let mut app = app();
    let (body, _, tip) = held_tube(&mut app);
    place(&mut app, tip, Transform::from_xyz(0.5, 2.0, 0.0));
    (0..200).for_each(|_| app.update());
    #[derive(Resource, Default)]
    struct Written(usize);
    app.init_resource::<Written>();
    app.add_systems(Last, |mut events: MessageReader<AssetEvent<Mesh>>, mut written: ResMut<Written>| {
        written.0 += events.read().filter(|event| matches!(event, AssetEvent::Modified { .. })).count();
    });
    app.update();
    app.world_mut().resource_mut::<Written>().0 = 0;
    app.update();
    assert_eq!(app.world().resource::<Written>().0, 0);
    place(&mut app, tip, Transform::from_xyz(0.6, 2.0, 0.0));
    app.update();
    assert_eq!(app.world().resource::<Written>().0, 1, "the renderer hears of it in the same frame");
    let at = (RINGS - 1) * (AROUND + 1);
    near(&rows(shown(&app, body), false)[at..=at], &[[0.9, 2.0, 0.0]], 1e-4);
}

#[test]
fn meshes_come_back_when_a_deformer_goes() {
    let mut app = app();
    let (body, _, tip) = held_tube(&mut app);
    place(&mut app, tip, Transform::from_xyz(0.5, 2.0, 0.0));
    settle(&mut app);
    assert_ne!(rows(shown(&app, body), false), rows(&tube(), false));
    // again: bound to the mesh as it was
    app.world_mut().entity_mut(body).insert(Deformer { links: None, ..default() });
    app.update();
    near(deformed(&app, body).rest(), rows(&tube(), false), 0.0);
    near(&rows(shown(&app, body), false)[(RINGS - 1) * (AROUND + 1)..][..1], &[[0.8, 2.0, 0.0]], 1e-4);
    // bound to another mesh
    let other = add(&mut app, tube().scaled_by(Vec3::splat(0.5)));
    app.world_mut().entity_mut(body).insert((Mesh3d(other), Deformer::default()));
    app.update();
    assert_eq!(deformed(&app, body).rest().iter().map(|p| p[1]).fold(0.0, f32::max), 1.0);
    let first = add(&mut app, tube());
    app.world_mut().entity_mut(body).insert((Mesh3d(first), Deformer::default()));
    app.update();
    app.world_mut().entity_mut(body).remove::<Deformer>();
    app.update();
    assert!(app.world().get::<DeformedMesh>(body).is_none());
    assert_eq!(rows(shown(&app, body), false), rows(&tube(), false));
    app.world_mut().despawn(body);
    app.update();
}

#[test]
fn a_deformer_waits_for_its_meshes() {
    let mut app = app();
    let reserved = app.world().resource::<Assets<Mesh>>().reserve_handle();
    let body = app.world_mut().spawn(Deformer::default()).id();
    let tip = handle(&mut app, body, [0.0, 2.0, 0.0]);
    app.update();
    app.world_mut().entity_mut(body).insert(Mesh3d(reserved.clone()));
    place(&mut app, tip, Transform::from_xyz(0.5, 2.0, 0.0));
    app.update();
    assert!(app.world().get::<DeformedMesh>(body).is_none() && error(&app, body).is_none());
    app.world_mut().resource_mut::<Assets<Mesh>>().insert(&reserved, tube()).unwrap();
    settle(&mut app);
    let at = (RINGS - 1) * (AROUND + 1);
    near(&rows(shown(&app, body), false)[at..=at], &[[0.8, 2.0, 0.0]], 1e-4);
}

#[test]
fn meshes_that_cannot_be_bound_say_why() {
    let mut app = app();
    let mut wrong = tube();
    wrong.insert_indices(Indices::U32(vec![0, 1, 1_000_000]));
    let mut gone = tube();
    gone.take_gpu_data().unwrap();
    for (mesh, code) in [(wrong, "HF_ERROR_OUT_OF_RANGE"), (gone, "HF_ERROR_INVALID_ARGUMENT")] {
        let mesh = add(&mut app, mesh);
        let body = app.world_mut().spawn((Deformer::default(), Mesh3d(mesh))).id();
        app.update();
        assert_eq!(error(&app, body), Some(code));
        // another mesh and another try
        let mesh = add(&mut app, tube());
        app.world_mut().entity_mut(body).insert((Mesh3d(mesh), Deformer::default()));
        app.update();
        assert!(app.world().get::<DeformedMesh>(body).is_some() && error(&app, body).is_none());
    }
}

#[test]
fn meshes_without_indices_or_normals_are_taken() {
    let mut app = app();
    let mut soup = tube();
    soup.duplicate_vertices(); // every corner its own vertex
    soup.remove_attribute(Mesh::ATTRIBUTE_NORMAL);
    let mesh = add(&mut app, soup);
    let body = app.world_mut().spawn((Deformer::default(), Mesh3d(mesh))).id();
    let (_, tip) = (handle(&mut app, body, [0.0, 0.0, 0.0]), handle(&mut app, body, [0.0, 2.0, 0.0]));
    app.update();
    place(&mut app, tip, Transform::from_xyz(0.5, 1.9, 0.0));
    settle(&mut app);
    // welded: corners that were one vertex still are
    let mut at: std::collections::HashMap<[u32; 3], [f32; 3]> = default();
    let deformed = deformed(&app, body);
    for (p, q) in deformed.rest().iter().zip(deformed.posed()) {
        assert_eq!(at.entry(p.map(f32::to_bits)).or_insert(*q), q);
    }
    assert!(rows(shown(&app, body), true).iter().all(|n| (Vec3::from_array(*n).length() - 1.0).abs() < 1e-4));
    assert!(at.len() <= RINGS * (AROUND + 1));
}

#[test]
fn a_skinned_mesh_is_taken_as_it_is_shown() {
    let mut app = app();
    let mut mesh = tube();
    let count = mesh.count_vertices();
    mesh.insert_attribute(Mesh::ATTRIBUTE_JOINT_INDEX, VertexAttributeValues::Uint16x4(vec![[0, 1, 0, 0]; count]));
    mesh.insert_attribute(Mesh::ATTRIBUTE_JOINT_WEIGHT, vec![[0.5f32, 0.5, 0.0, 0.0]; count]);
    let mesh = add(&mut app, mesh);
    let inverse = app.world_mut().resource_mut::<Assets<SkinnedMeshInverseBindposes>>().add(vec![Mat4::IDENTITY; 2]);
    let body = app.world_mut().spawn(Deformer::default()).id();
    let joints = [1.0, 3.0].map(|x| app.world_mut().spawn((Transform::from_xyz(x, 0.0, 0.0), ChildOf(body))).id());
    // the place of a skinned mesh has no effect on what is shown
    let skin = SkinnedMesh { inverse_bindposes: inverse, joints: joints.to_vec() };
    let part = app.world_mut().spawn((Mesh3d(mesh), skin, Transform::from_xyz(0.0, 50.0, 0.0), ChildOf(body))).id();
    app.update();
    let wanted: Vec<_> = rows(&tube(), false).iter().map(|p| [p[0] + 2.0, p[1], p[2]]).collect();
    near(deformed(&app, body).rest(), &wanted, 1e-5);
    let local: Vec<_> = wanted.iter().map(|p| [p[0], p[1] - 50.0, p[2]]).collect();
    near(rows(shown(&app, part), false), &local, 1e-5);
    assert!(app.world().get::<SkinnedMesh>(part).is_none() && !shown(&app, part).contains_attribute(Mesh::ATTRIBUTE_JOINT_INDEX));
    app.world_mut().entity_mut(body).remove::<Deformer>();
    app.update();
    assert!(app.world().get::<SkinnedMesh>(part).is_some() && shown(&app, part).contains_attribute(Mesh::ATTRIBUTE_JOINT_INDEX));
}

#[test]
fn a_click_hits_the_posed_surface() {
    let mut app = app();
    let (body, _, tip) = held_tube(&mut app);
    place(&mut app, tip, Transform::from_xyz(2.0, 2.0, 0.0));
    settle(&mut app);
    let pick = |x: f32| deformed(&app, body).pick(Vec3::new(x, 1.9, 5.0), Vec3::NEG_Z).unwrap();
    assert!(pick(2.0).is_some() && pick(0.0).is_none());
    assert!(!deformed(&app, body).propose_handles().unwrap().is_empty());
}

/// A skin of a body with a head, whose vertices the head alone moves.
#[test]
fn a_skeleton_names_the_proposals_and_a_head_is_whole() {
    let mut app = app();
    let joints = skeleton(&mut app, 1.0, 0.4);
    let (mut positions, mut triangles, mut of) = (vec![], vec![], vec![]);
    for (joint, (_, parent, _)) in JOINTS.iter().enumerate() {
        let above = if *parent == 9 { joint } else { *parent };
        let [low, high] = [above, joint].map(at_rest);
        let (low, high) = if *parent == 9 { (low - Vec3::Y * 0.1, high + Vec3::Y * 0.1) } else { (low, high) };
        let thick = if joint == 2 { 0.15 } else { 0.06 };
        let (low, high) = (low.min(high) - thick, low.max(high) + thick);
        let first = positions.len() as u32;
        let side = |bit: usize, low: f32, high: f32| move |corner: usize| if corner >> bit & 1 == 1 { high } else { low };
        let [x, y, z] = [(0, low.x, high.x), (1, low.y, high.y), (2, low.z, high.z)].map(|(bit, low, high)| side(bit, low, high));
        positions.extend((0..8).map(|corner| [x(corner), y(corner), z(corner)]));
        let faces = [
            [0, 2, 3],
            [0, 3, 1],
            [4, 5, 7],
            [4, 7, 6],
            [0, 1, 5],
            [0, 5, 4],
            [2, 6, 7],
            [2, 7, 3],
            [0, 4, 6],
            [0, 6, 2],
            [1, 3, 7],
            [1, 7, 5],
        ];
        triangles.extend(faces.into_iter().flatten().map(|corner: u32| first + corner));
        of.extend([[joint as u16, 0, 0, 0]; 8]);
    }
    let count = positions.len();
    let mesh = Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::default())
        .with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, positions)
        .with_inserted_attribute(Mesh::ATTRIBUTE_JOINT_INDEX, VertexAttributeValues::Uint16x4(of))
        .with_inserted_attribute(Mesh::ATTRIBUTE_JOINT_WEIGHT, vec![[1.0f32, 0.0, 0.0, 0.0]; count])
        .with_inserted_indices(Indices::U32(triangles));
    let mesh = add(&mut app, mesh);
    app.update();
    let binds: Vec<Mat4> = joints.iter().map(|&joint| app.world().get::<GlobalTransform>(joint).unwrap().to_matrix().inverse()).collect();
    let inverse = app.world_mut().resource_mut::<Assets<SkinnedMeshInverseBindposes>>().add(binds);
    let body = app.world_mut().spawn(Deformer::default()).id();
    app.world_mut().entity_mut(joints[0]).insert(ChildOf(body));
    app.world_mut().spawn((Mesh3d(mesh), SkinnedMesh { inverse_bindposes: inverse, joints: joints.clone() }, ChildOf(body)));
    app.update();
    assert!(deformed(&app, body).skeleton().is_some(), "{:?}", error(&app, body));
    let proposals = deformed(&app, body).propose_regions().unwrap();
    let (head, region) = proposals.iter().find(|(proposal, _)| proposal.role == hf_bevy::hf::raw::HF_ROLE_HEAD).expect("a head");
    assert_eq!(deformed(&app, body).joint(head), Some(joints[2]));
    assert!(
        head.pinned == 0 && proposals.iter().filter(|(one, _)| one.pinned == 1 && one.role == hf_bevy::hf::raw::HF_ROLE_FOOT).count() == 2
    );
    let own = deformed(&app, body).rest().len() as u32 / 9;
    assert_eq!(region.0.to_vec(), (2 * own..3 * own).collect::<Vec<_>>());
    let (point, region) = (DVec3::from_array(head.position).as_vec3(), region.clone());
    let handle = app.world_mut().spawn((DeformHandle::tip(body, point, head.radius as f32), region)).id();
    place(&mut app, handle, Transform::from_translation(point + Vec3::Y * 0.1).with_rotation(Quat::from_rotation_y(0.5)));
    settle(&mut app);
    let (rest, posed) = (deformed(&app, body).rest().to_vec(), deformed(&app, body).posed().to_vec());
    let between = |at: &[[f32; 3]], a: usize, b: usize| Vec3::from_array(at[a]).distance(Vec3::from_array(at[b]));
    let (first, last) = (2 * own as usize, 3 * own as usize - 1);
    assert!((between(&rest, first, last) - between(&posed, first, last)).abs() < 1e-4, "a whole head keeps its shape");
}

/// Where a joint of [`skeleton`] stands at rest.
fn at_rest(joint: usize) -> Vec3 {
    let (_, parent, place) = JOINTS[joint];
    Vec3::from_array(place) + if parent == 9 { Vec3::ZERO } else { at_rest(parent) }
}

/// A flat body of squares: a trunk from y = 0 to 12, and an arm to x = 12 at its shoulder.
fn body_with_arm() -> Mesh {
    let (mut positions, mut triangles) = (vec![], vec![]);
    for y in 0..12 {
        for x in 0..if (8..10).contains(&y) { 12 } else { 4 } {
            let first = positions.len() as u32; // corners are welded
            positions.extend([(0, 0), (1, 0), (0, 1), (1, 1)].map(|(u, v)| [(x + u) as f32, (y + v) as f32, 0.0]));
            triangles.extend([0, 1, 2, 1, 3, 2].map(|corner| first + corner));
        }
    }
    Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::default())
        .with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, positions)
        .with_inserted_indices(Indices::U32(triangles))
}

#[test]
fn a_dragged_tip_hardly_moves_the_head() {
    let mut app = app();
    let mesh = add(&mut app, body_with_arm());
    let body = app.world_mut().spawn((Deformer::default(), Mesh3d(mesh))).id();
    app.world_mut().spawn(DeformHandle::at(body, Vec3::new(2.0, 0.0, 0.0), 1.2));
    let hand = app.world_mut().spawn(DeformHandle::tip(body, Vec3::new(12.0, 9.0, 0.0), 1.2)).id();
    app.update();
    place(&mut app, hand, Transform::from_xyz(9.0, 13.0, 0.0));
    let mut moves = |limb: HandleLimb, point: [f32; 3]| {
        *app.world_mut().get_mut::<HandleLimb>(hand).unwrap() = limb;
        (0..60).for_each(|_| app.update());
        let deformed = deformed(&app, body);
        let at = deformed.rest().iter().position(|p| *p == point).unwrap();
        Vec3::from_array(deformed.posed()[at])
    };
    let (head, box_size) = ([2.0, 12.0, 0.0], 288f32.sqrt());
    let tip = HandleLimb { following: 0.25, ..default() };
    let [held, all, again] = [tip, default(), tip].map(|limb| moves(limb, head).distance(head.into()) / box_size);
    assert!(held < 0.03 && held < 0.5 * all, "{held} of the box, {all} where all follows");
    assert!((held - again).abs() < 1e-3, "{held} {again}");
    // a limb that keeps its lengths goes elsewhere, and the head stays
    let kept = HandleLimb { keep_lengths: true, ..tip };
    let [elbow, top] = [[8.0, 9.0, 0.0], head].map(|point| moves(tip, point).distance(moves(kept, point)));
    assert!(elbow > 0.01 && top < 1e-3, "{elbow} {top}");
    moves(HandleLimb { following: 2.0, ..default() }, head);
    assert_eq!(error(&app, hand), Some("HF_ERROR_INVALID_ARGUMENT"));
}

const JOINTS: [(&str, usize, [f32; 3]); 9] = [
    ("hips", 9, [0.0, 1.0, 0.0]),
    ("spine", 0, [0.0, 0.3, 0.0]),
    ("head", 1, [0.0, 0.4, 0.0]),
    ("left_thigh", 0, [0.1, -0.05, 0.0]),
    ("left_shin", 3, [0.0, -0.45, 0.02]),
    ("left_foot", 4, [0.0, -0.42, -0.02]),
    ("right_thigh", 0, [-0.1, -0.05, 0.0]),
    ("right_shin", 6, [0.0, -0.45, 0.02]),
    ("right_foot", 7, [0.0, -0.42, -0.02]),
];

/// A body of joints whose frames are turned by `roll` about x, which moves no joint.
fn skeleton(app: &mut App, size: f32, roll: f32) -> Vec<Entity> {
    let mut made: Vec<Entity> = vec![];
    for (name, parent, place) in JOINTS {
        let place = size * Vec3::from_array(place);
        let transform = match parent {
            9 => Transform::from_translation(place).with_rotation(Quat::from_rotation_x(roll)),
            _ => Transform::from_translation(Quat::from_rotation_x(-roll) * place),
        };
        let joint = app.world_mut().spawn((Name::new(name), transform)).id();
        if parent < 9 {
            app.world_mut().entity_mut(joint).insert(ChildOf(made[parent]));
        }
        made.push(joint);
    }
    made
}

/// The plain arrays of joints, depth first, as `Retarget` takes them.
fn plain(app: &App, joints: &[Entity]) -> Vec<f32> {
    let of = |&joint| *app.world().get::<Transform>(joint).unwrap();
    joints.iter().map(of).flat_map(|t| [&t.translation.to_array()[..], &t.rotation.to_array(), &t.scale.to_array()].concat()).collect()
}

#[test]
fn a_frame_is_what_the_library_makes_of_the_plain_arrays() {
    let mut app = app();
    let (man, robot) = (skeleton(&mut app, 1.0, 0.0), skeleton(&mut app, 2.0, 1.2));
    let parents = JOINTS.map(|(_, parent, _)| if parent == 9 { hf_bevy::hf::raw::HF_NO_INDEX } else { parent as u32 });
    let known = |app: &App, joints: &[Entity]| {
        hf_bevy::hf::Skeleton::new(Some(&JOINTS.map(|(name, ..)| name)), &parents, &plain(app, joints), &default()).unwrap()
    };
    let mut wanted = hf_bevy::hf::Retarget::new(&known(&app, &man), &known(&app, &robot), &default()).unwrap();
    let player = app.world_mut().spawn(Retarget { source: man[0], target: robot[0], options: default() }).id();
    let rest = plain(&app, &robot);
    app.update();
    let matched = app.world().get::<Retargeted>(player).unwrap().retarget.info().unwrap().matched_joint_count;
    assert_eq!(matched as usize, JOINTS.len());
    wanted.solve(&plain(&app, &man), app.world().resource::<Time>().delta_secs_f64()).unwrap();
    for frame in 0..20 {
        app.world_mut().get_mut::<Transform>(man[0]).unwrap().translation.z = 0.05 * frame as f32;
        app.world_mut().get_mut::<Transform>(man[3]).unwrap().rotation = Quat::from_rotation_x(-0.05 * frame as f32);
        app.update();
        let seconds = app.world().resource::<Time>().delta_secs_f64();
        assert_eq!(plain(&app, &robot), wanted.solve(&plain(&app, &man), seconds).unwrap(), "frame {frame}");
    }
    let most = plain(&app, &robot).iter().zip(&rest).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
    assert!(most > 1.0, "the robot walks on: {most}");
    // what is refused changes nothing, and a skeleton of nothing says why
    let stood = plain(&app, &robot);
    app.world_mut().get_mut::<Transform>(man[3]).unwrap().rotation.x = f32::NAN;
    app.update();
    assert_eq!(plain(&app, &robot), stood);
    let rock = app.world_mut().spawn((Name::new("rock"), Transform::IDENTITY)).id();
    app.world_mut().spawn((Name::new("pebble"), Transform::IDENTITY, ChildOf(rock)));
    app.world_mut().entity_mut(player).insert(Retarget { source: rock, target: robot[0], options: default() });
    app.update();
    app.update();
    assert!(app.world().get::<Retargeted>(player).is_none() && error(&app, player).is_some());
}
