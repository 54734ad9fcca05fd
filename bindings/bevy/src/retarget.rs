//! Plays the motion of one skeleton on another.
use crate::DeformError;
use bevy::app::AnimationSystems;
use bevy::log::warn;
use bevy::prelude::*;
use bevy::transform::TransformSystems;

/// Adds the systems that pair skeletons and play them, in `PostUpdate` around [`AnimationSystems`].
pub struct RetargetPlugin;

impl Plugin for RetargetPlugin {
    fn build(&self, app: &mut App) {
        app.add_systems(
            PostUpdate,
            // skeletons are paired at rest: before a clip moves them
            (pair.before(AnimationSystems), play.after(AnimationSystems).before(TransformSystems::Propagate)),
        )
        .add_observer(on_insert);
    }
}

/// The joints of one skeleton follow those of another in every frame. Put it on any entity.
///
/// A skeleton is the entity of its topmost joint and all entities below, with their `Name`. Both must be at rest when the
/// component is inserted; it waits until both exist. The entity then has [`Retargeted`], or a [`DeformError`] that says why not.
/// Animate the source as you like; nothing else may move the target. Insert the component again to pair again.
#[derive(Component, Clone, Copy, Debug)]
pub struct Retarget {
    /// the topmost joint that moves
    pub source: Entity,
    /// the topmost joint that follows
    pub target: Entity,
    /// how joints are paired
    pub options: hf::RetargetOptions<'static>,
}

/// The paired skeletons of a [`Retarget`]. The plugin makes it.
#[derive(Component)]
pub struct Retargeted {
    source: Vec<Entity>,
    target: Vec<Entity>,
    /// `info` says how well the skeletons fit; call `reset` where a clip jumps
    pub retarget: hf::Retarget,
    pose: Vec<f32>,
}

/// A joint as 10 numbers: translation, rotation x y z w, scale.
fn numbers(joint: &Transform) -> [f32; 10] {
    let ([x, y, z], [a, b, c, d], [u, v, w]) = (joint.translation.into(), joint.rotation.into(), joint.scale.into());
    [x, y, z, a, b, c, d, u, v, w]
}

struct Joints {
    entities: Vec<Entity>,
    rest: Vec<f32>,
    skeleton: hf::Skeleton,
}

type Below<'w, 's> = Query<'w, 's, (&'static Transform, Option<&'static Name>, Option<&'static Children>)>;

/// Reads a skeleton from its topmost joint; `None` while the entity or its children do not exist.
fn joints(top: Entity, below: &Below) -> Option<hf::Result<Joints>> {
    below.get(top).ok()?.2?;
    let (mut stack, mut entities, mut parents, mut rest, mut names) = (vec![(top, hf::raw::HF_NO_INDEX)], vec![], vec![], vec![], vec![]);
    while let Some((entity, parent)) = stack.pop() {
        let Ok((transform, name, children)) = below.get(entity) else { continue };
        stack.extend(children.into_iter().flat_map(|list| list.iter().rev()).map(|child| (child, entities.len() as u32)));
        entities.push(entity);
        parents.push(parent);
        rest.extend(numbers(transform));
        names.push(name.map_or("", |name| name.as_str()));
    }
    Some(hf::Skeleton::new(Some(&names), &parents, &rest, &default()).map(|skeleton| Joints { entities, rest, skeleton }))
}

fn pair(new: Query<(Entity, &Retarget), (Without<Retargeted>, Without<DeformError>)>, below: Below, mut commands: Commands) {
    for (entity, wanted) in &new {
        let (Some(source), Some(target)) = (joints(wanted.source, &below), joints(wanted.target, &below)) else { continue };
        let made = source.and_then(|source| {
            let target = target?;
            let retarget = hf::Retarget::new(&source.skeleton, &target.skeleton, &wanted.options)?;
            Ok(Retargeted { source: source.entities, target: target.entities, retarget, pose: source.rest })
        });
        match made {
            Ok(made) => {
                commands.entity(entity).insert(made);
            }
            Err(error) => {
                warn!("retarget {entity}: {error}");
                commands.entity(entity).insert(DeformError(error));
            }
        }
    }
}

fn play(mut playing: Query<&mut Retargeted>, mut joints: Query<&mut Transform>, time: Res<Time>) {
    for mut playing in &mut playing {
        let Retargeted { source, target, retarget, pose } = &mut *playing;
        for (&entity, row) in source.iter().zip(pose.as_chunks_mut::<10>().0) {
            if let Ok(joint) = joints.get(entity) {
                *row = numbers(joint);
            }
        }
        let posed = match retarget.solve(pose, time.delta_secs_f64()) {
            Ok(posed) => posed,
            Err(error) => {
                warn!("{error}");
                continue;
            }
        };
        for (&entity, &[x, y, z, a, b, c, d, u, v, w]) in target.iter().zip(posed.as_chunks::<10>().0) {
            if let Ok(mut joint) = joints.get_mut(entity) {
                *joint = Transform { translation: Vec3::new(x, y, z), rotation: Quat::from_xyzw(a, b, c, d), scale: Vec3::new(u, v, w) };
            }
        }
    }
}

/// Removes the old pair or error when a [`Retarget`] is inserted, so that the skeletons are paired again.
fn on_insert(inserted: On<Insert, Retarget>, mut commands: Commands) {
    commands.entity(inserted.entity).try_remove::<(Retargeted, DeformError)>();
}
