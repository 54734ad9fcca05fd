#![doc = include_str!("../README.md")]
#![warn(missing_docs)]
#![allow(clippy::type_complexity)] // queries are long types
mod bind;
#[cfg(feature = "gpu")]
mod blend;
mod deformed;
#[cfg(feature = "gpu")]
mod gpu;
mod retarget;
mod shading;

pub use crate::deformed::DeformedMesh;
#[cfg(feature = "gpu")]
pub use crate::gpu::{BlendMaterial, Blended, GpuBlend, GpuBlendPlugin};
pub use crate::retarget::{Retarget, RetargetPlugin, Retargeted};
pub use hf;

use bevy::asset::AssetEventSystems;
use bevy::ecs::entity::EntityHashMap;
use bevy::log::warn;
use bevy::math::Affine3A;
use bevy::prelude::*;
use bevy::transform::TransformSystems;
use std::sync::Arc;

/// Adds the systems that bind, pose and write meshes, in `PostUpdate` after transforms are propagated.
///
/// It needs the plugins of assets, meshes and transforms; no window and no renderer.
pub struct DeformPlugin;

/// The set of the plugin's systems in `PostUpdate`. After it, meshes hold the pose of this frame.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct DeformSystems;

impl Plugin for DeformPlugin {
    fn build(&self, app: &mut App) {
        // the renderer takes changed meshes from the asset events of the same frame
        let set = DeformSystems.after(TransformSystems::Propagate).before(AssetEventSystems);
        app.configure_sets(PostUpdate, set)
            .add_systems(PostUpdate, (bind::bind, pose_meshes, write_meshes).chain().in_set(DeformSystems))
            .add_observer(bind::on_insert)
            .add_observer(bind::on_remove)
            .add_observer(bind::on_deformer_removed);
    }
}

/// Makes the meshes of an entity and of its descendants follow handles. All of them are one surface.
///
/// The surface is made in the first `PostUpdate` in which every mesh is loaded. The entity then has a [`DeformedMesh`], or a
/// [`DeformError`] that says why not. Insert the component again to bind again. Remove it to get the meshes back as they were.
#[derive(Component, Clone, Copy, Debug)]
#[require(Transform)]
pub struct Deformer {
    /// how the surface is made
    pub surface: hf::SurfaceOptions<'static>,
    /// how pieces that are not connected are linked, such as eyes and clothes: by default all that are near; `None`: they are not
    pub links: Option<hf::Links<'static>>,
    /// how the pose is made
    pub pose: hf::PoseOptions,
    /// how a frame is deformed
    pub deform: hf::DeformOptions,
}

impl Default for Deformer {
    fn default() -> Self {
        let links = Some(hf::Links { mode: hf::raw::HF_LINK_PIECES, ..default() });
        Deformer { surface: default(), links, pose: default(), deform: default() }
    }
}

/// A handle: its entity's `Transform` moves a region of the surface of `deformer`.
///
/// The surface is at rest where the entity stands at `point` without a rotation, in the space of the deformer. From there the
/// region moves rigidly with the entity, and turns as [`HandleRotation`] says. Scale is ignored. The entity can be a child of anything. Spawn, change and despawn
/// handles at any time: nothing is factorised again. A handle that is refused gets a [`DeformError`].
#[derive(Component, Clone, Copy, Debug, PartialEq)]
#[require(Transform, HandleRotation, HandleLimb)]
pub struct DeformHandle {
    /// the entity with the [`Deformer`]
    pub deformer: Entity,
    /// a point of the surface at rest, in the space of the deformer
    pub point: Vec3,
    /// the region is what is edge-connected to the nearest vertex within this distance of the point, 0 or more
    pub radius: f32,
    /// 0, or a finer layer that edits what the lower layers give (hf/pose.h)
    pub layer: u32,
}

impl DeformHandle {
    /// A handle at its rest place, as a child of the deformer. All of the surface follows it.
    pub fn at(deformer: Entity, point: Vec3, radius: f32) -> impl Bundle {
        (DeformHandle { deformer, point, radius, layer: 0 }, Transform::from_translation(point), ChildOf(deformer))
    }

    /// A handle as [`DeformHandle::at`] for a tip that is dragged, such as a hand: its limb follows, and the body hardly leans.
    pub fn tip(deformer: Entity, point: Vec3, radius: f32) -> impl Bundle {
        (Self::at(deformer, point, radius), HandleLimb { following: TIP_FOLLOWING, ..default() })
    }
}

/// The following of a tip that is dragged: its limb follows and the body hardly leans. hf_surface_propose_handles proposes the same number.
pub const TIP_FOLLOWING: f64 = 0.25;

/// How the surface follows a [`DeformHandle`] of layer 0. Handles of other layers ignore it.
#[derive(Component, Clone, Copy, Debug, PartialEq)]
pub struct HandleLimb {
    /// 1: all of the surface follows the handle; 0: its limb alone, such as an arm
    pub following: f64,
    /// the limb keeps its lengths and bends like two bones; the rest stays as it is
    pub keep_lengths: bool,
}

impl Default for HandleLimb {
    fn default() -> Self {
        HandleLimb { following: 1.0, keep_lengths: false }
    }
}

/// The vertices of the region of a [`DeformHandle`], of the surface and in ascending order, in place of its radius. The plugin
/// proposes them: [`DeformedMesh::propose_regions`].
#[derive(Component, Clone, Debug, PartialEq, Eq)]
pub struct HandleRegion(pub Arc<[u32]>);

/// Who says how the region of a [`DeformHandle`] is turned.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum HandleRotation {
    /// A handle at rest holds. When its entity moves, the pose finds the rotation, as a wrist follows a hand. When its entity is
    /// turned, the entity gives the rotation from then on, from where the region stands. Above layer 0 as `Given`.
    #[default]
    Automatic,
    /// The pose finds the rotation: the handle is a place alone.
    Free,
    /// The entity gives the rotation.
    Given,
}

/// Why a deformer or a handle has no effect. It goes when the cause goes.
#[derive(Component, Clone, Debug, PartialEq, Eq)]
pub struct DeformError(pub hf::Error);

/// Transforms and parents, to find where an entity stands in the space of another.
type Places<'w, 's> = Query<'w, 's, (&'static Transform, &'static GlobalTransform, Option<&'static ChildOf>)>;

/// The place of `entity` in the space of `root`. A descendant of the root loses no precision far from the world's origin.
fn place_in(places: &Places, entity: Entity, root: Entity) -> Option<Affine3A> {
    let (mut here, mut place) = (entity, Affine3A::IDENTITY);
    while here != root {
        let (local, _, parent) = places.get(here).ok()?;
        let Some(parent) = parent else {
            let (of_root, of_entity) = (places.get(root).ok()?.1, places.get(entity).ok()?.1);
            return Some(of_root.affine().inverse() * of_entity.affine());
        };
        (here, place) = (parent.parent(), local.compute_affine() * place);
    }
    Some(place)
}

/// A handle as its entity says, and where the entity stands now.
struct Wanted {
    entity: Entity,
    handle: DeformHandle,
    rotation: HandleRotation,
    limb: HandleLimb,
    region: Option<HandleRegion>,
    place: Affine3A,
}

fn pose_meshes(
    mut deformed: Query<(Entity, &mut DeformedMesh, &Deformer)>,
    handles: Query<(Entity, &DeformHandle, &HandleRotation, &HandleLimb, Option<&HandleRegion>)>,
    places: Places,
) {
    let mut wanted: EntityHashMap<Vec<Wanted>> = default();
    for (entity, &handle, &rotation, &limb, region) in &handles {
        if let Some(place) = place_in(&places, entity, handle.deformer) {
            let region = region.cloned();
            wanted.entry(handle.deformer).or_default().push(Wanted { entity, handle, rotation, limb, region, place });
        }
    }
    // a pose depends on the order in which its handles are added, and a query has none
    wanted.values_mut().for_each(|list| list.sort_unstable_by_key(|wanted| wanted.entity));
    // surfaces share nothing: each is posed on a thread of the engine
    deformed.par_iter_mut().for_each(|(entity, mut deformed, deformer)| {
        let list = wanted.get(&entity).map_or(&[][..], |list| list);
        if deformed.bypass_change_detection().pose(list, &deformer.deform) {
            deformed.set_changed();
        }
    });
}

fn write_meshes(mut deformed: Query<&mut DeformedMesh>, mut meshes: ResMut<Assets<Mesh>>, mut commands: Commands) {
    for mut deformed in &mut deformed {
        let deformed = deformed.bypass_change_detection();
        deformed.write(&mut meshes);
        for (entity, error) in deformed.said() {
            let Ok(mut about) = commands.get_entity(entity) else { continue };
            match error {
                Some(error) => {
                    warn!("handle {entity}: {error}");
                    about.try_insert(DeformError(error));
                }
                None => {
                    about.try_remove::<DeformError>();
                }
            }
        }
    }
}
