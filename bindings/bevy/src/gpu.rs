//! Vertices that the GPU blends: a material whose vertex shader is that of hf, and its buffers.
//!
//! The rows of a pose go to the GPU when handles come or go, the transforms of its clusters in every frame that moves. The
//! meshes hold the rest shape and are written no more. Where a pose is no blend, they are written as before.
use crate::blend::Blend;
use crate::deformed::DeformedMesh;
use crate::{DeformSystems, bind, pose_meshes, write_meshes};
use bevy::asset::{AssetMut, RenderAssetUsages, uuid_handle};
use bevy::camera::primitives::Aabb;
use bevy::camera::visibility::{NoAutoAabb, VisibilitySystems};
use bevy::ecs::system::SystemParamItem;
use bevy::ecs::system::lifetimeless::SRes;
use bevy::math::{Affine3A, DVec3, Vec3A};
use bevy::pbr::{ExtendedMaterial, MaterialExtension, MaterialPlugin, PbrPlugin};
use bevy::prelude::*;
use bevy::render::erased_render_asset::prepare_erased_assets;
use bevy::render::render_asset::{RenderAssets, prepare_assets};
use bevy::render::render_resource::{
    AsBindGroup, AsBindGroupError, BindGroupLayout, BindGroupLayoutEntry, BindingResources, BindingType, BufferBindingType, BufferUsages,
    OwnedBindingResource, ShaderStages, UnpreparedBindGroup,
};
use bevy::render::renderer::RenderDevice;
use bevy::render::storage::{GpuShaderBuffer, ShaderBuffer};
use bevy::render::{Render, RenderApp};
use bevy::shader::{Shader, ShaderRef};

/// The GPU blends the vertices of this [`Deformer`](crate::Deformer). It needs [`GpuBlendPlugin`].
///
/// The processor solves the pose and touches no vertex. Meshes with a `StandardMaterial` keep it, as the base of a
/// [`BlendMaterial`]; a change of the asset is taken over. Insert and remove the component at any time. As long as the pose is no
/// blend, the processor writes the meshes: with handles above layer 0, with [`HandleLimb::keep_lengths`](crate::HandleLimb), with
/// `refine`, without a `StandardMaterial`, and where the GPU has fewer than 8 storage buffers for a shader (WebGL 2).
#[derive(Component, Clone, Copy, Debug, Default)]
pub struct GpuBlend;

/// Draws deformers that have a [`GpuBlend`]. Add it after `DefaultPlugins`. Without a renderer it does nothing.
pub struct GpuBlendPlugin;

/// The material of a mesh that the GPU blends.
pub type BlendMaterial = ExtendedMaterial<StandardMaterial, Blended>;

/// What [`BlendMaterial`] adds: the buffers of `bindings/shaders/hf_blend.wgsl`.
#[derive(Asset, TypePath, Clone, Debug)]
pub struct Blended([Handle<ShaderBuffer>; 8]);

/// Buffers in the order of their bindings, which begin at 100: extensions of materials do so.
const FIRST_BINDING: u32 = 100;
const FRAME: usize = 0;
const ROWS: usize = 1;
const CLUSTERS: usize = 2;
const WEIGHTS: usize = 3;
const GRADIENTS: usize = 4;
const OFFSETS: usize = 5;
const TRANSFORMS: usize = 6;
const PART: usize = 7;
/// Storage buffers of a vertex shader: six of ours, and two of the engine.
const STORAGE_BUFFERS: u32 = 8;

const VERTEX: Handle<Shader> = uuid_handle!("5f1f0d6c-3a0e-4f3c-9a38-6d1f6c1b7a01");
const MODULE: Handle<Shader> = uuid_handle!("5f1f0d6c-3a0e-4f3c-9a38-6d1f6c1b7a02");

/// The one source of hf's shaders as a module of Bevy: its bindings are in the group of the material, and its entry is cut off.
fn module() -> String {
    let source = include_str!("../../shaders/hf_blend.wgsl");
    let kept = source.split_once("// ---- compute").expect("hf_blend.wgsl has a part named compute").0;
    let own = |line: &&str| !["@binding(5)", "@binding(7)"].iter().any(|binding| line.contains(binding));
    let text: Vec<&str> = kept.lines().filter(own).collect();
    "#define_import_path hf::blend\n".to_string()
        + &text.join("\n").replace("@group(0) @binding(", "@group(#{MATERIAL_BIND_GROUP}) @binding(10")
}

impl Plugin for GpuBlendPlugin {
    fn build(&self, app: &mut App) {
        if !app.is_plugin_added::<PbrPlugin>() || app.get_sub_app(RenderApp).is_none() {
            return;
        }
        app.add_plugins(MaterialPlugin::<BlendMaterial>::default());
        let mut shaders = app.world_mut().resource_mut::<Assets<Shader>>();
        for (handle, text, path) in [(MODULE, module(), "hf/hf_blend.wgsl"), (VERTEX, include_str!("blend.wgsl").into(), "hf/blend.wgsl")] {
            shaders.insert(&handle, Shader::from_wgsl(text, path)).expect("a shader has a number of its own");
        }
        app.configure_sets(PostUpdate, DeformSystems.before(VisibilitySystems::CheckVisibility))
            .add_systems(
                PostUpdate,
                ((follow_materials, begin).chain().after(bind::bind).before(pose_meshes).run_if(can_blend), upload.after(write_meshes))
                    .in_set(DeformSystems),
            )
            .add_observer(on_blend_removed)
            .add_observer(on_deformed_removed);
        // a material that binds new buffers finds them in the frame in which they come
        let order = (|| {}).after(prepare_assets::<GpuShaderBuffer>).before(prepare_erased_assets::<MeshMaterial3d<BlendMaterial>>);
        app.sub_app_mut(RenderApp).add_systems(Render, order);
    }
}

fn can_blend(device: Option<Res<RenderDevice>>) -> bool {
    device.is_some_and(|device| device.limits().max_storage_buffers_per_shader_stage >= STORAGE_BUFFERS)
}

impl MaterialExtension for Blended {
    fn vertex_shader() -> ShaderRef {
        VERTEX.into()
    }

    fn prepass_vertex_shader() -> ShaderRef {
        VERTEX.into()
    }

    fn deferred_vertex_shader() -> ShaderRef {
        VERTEX.into()
    }
}

impl AsBindGroup for Blended {
    type Data = ();
    type Param = SRes<RenderAssets<GpuShaderBuffer>>;

    fn label() -> &'static str {
        "hf_blend"
    }

    fn bind_group_data(&self) {}

    fn unprepared_bind_group(
        &self,
        _: &BindGroupLayout,
        _: &RenderDevice,
        buffers: &mut SystemParamItem<'_, '_, Self::Param>,
        _: bool,
    ) -> Result<UnpreparedBindGroup, AsBindGroupError> {
        let bound = |(binding, handle): (u32, &Handle<ShaderBuffer>)| {
            let buffer = buffers.get(handle).ok_or(AsBindGroupError::RetryNextUpdate)?;
            Ok((binding, OwnedBindingResource::Buffer(buffer.buffer.clone())))
        };
        let bindings = (FIRST_BINDING..).zip(&self.0).map(bound).collect::<Result<_, AsBindGroupError>>()?;
        Ok(UnpreparedBindGroup { bindings: BindingResources(bindings) })
    }

    fn bind_group_layout_entries(_: &RenderDevice, _: bool) -> Vec<BindGroupLayoutEntry> {
        let entry = |number: usize| {
            let uniform = number == FRAME || number == PART;
            let ty = if uniform { BufferBindingType::Uniform } else { BufferBindingType::Storage { read_only: true } };
            BindGroupLayoutEntry {
                binding: FIRST_BINDING + number as u32,
                visibility: ShaderStages::VERTEX,
                ty: BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None },
                count: None,
            }
        };
        (0..PART + 1).map(entry).collect()
    }
}

/// The buffers of a deformer, and the meshes that are drawn with them.
#[derive(Component)]
pub(crate) struct BlendBuffers {
    shared: [Handle<ShaderBuffer>; PART],
    parts: Vec<BlendedPart>,
}

struct BlendedPart {
    entity: Entity,
    place: Handle<ShaderBuffer>,
    material: Handle<BlendMaterial>,
    standard: Handle<StandardMaterial>,
}

fn bytes<const N: usize, T: Copy>(values: &[T], of: impl Fn(T) -> [u8; N]) -> Vec<u8> {
    values.iter().flat_map(|value| of(*value)).collect()
}

fn floats(values: &[f32]) -> Vec<u8> {
    bytes(values, f32::to_le_bytes)
}

/// HfFrame of the shaders: the present transforms are the first half of their buffer.
fn frame(vertex_count: usize, clusters: usize, shares: [f32; 2]) -> Vec<u8> {
    let counts = [vertex_count as u32, clusters as u32, 0, clusters as u32];
    [bytes(&counts, u32::to_le_bytes), floats(&[shares[0], shares[1], 0.0, 0.0])].concat()
}

/// `Part` of blend.wgsl.
fn part(into_mesh: Affine3A, centre: DVec3, first: usize) -> Vec<u8> {
    let mut to_rest = into_mesh.inverse();
    to_rest.translation = (to_rest.translation.as_dvec3() - centre).as_vec3a();
    let to_mesh = into_mesh * Affine3A::from_translation(centre.as_vec3());
    let rows = [to_rest, to_mesh].map(|affine| Mat4::from(affine).transpose().to_cols_array());
    let rows: Vec<f32> = rows.iter().flat_map(|matrix| matrix[..12].iter().copied()).collect();
    [floats(&rows), bytes(&[first as u32, 0, 0, 0], u32::to_le_bytes)].concat()
}

/// Gives deformers their buffers, and the meshes a material that reads them.
fn begin(
    mut new: Query<(Entity, &mut DeformedMesh), (With<GpuBlend>, Without<BlendBuffers>)>,
    shown: Query<&MeshMaterial3d<StandardMaterial>>,
    standards: Res<Assets<StandardMaterial>>,
    mut materials: ResMut<Assets<BlendMaterial>>,
    mut buffers: ResMut<Assets<ShaderBuffer>>,
    mut commands: Commands,
) {
    for (root, mut deformed) in &mut new {
        let drawn = |entity| {
            let standard = shown.get(entity).ok()?.0.clone();
            Some((entity, standards.get(&standard)?.clone(), standard))
        };
        // later, when each mesh has a material
        let Some(drawn) = deformed.parts.iter().map(|part| drawn(part.entity)).collect::<Option<Vec<_>>>() else { continue };
        let mut buffer = |data: Vec<u8>, usage| {
            let mut made = ShaderBuffer::new(&data, RenderAssetUsages::RENDER_WORLD);
            made.buffer_description.usage = usage | BufferUsages::COPY_DST;
            buffers.add(made)
        };
        let shared = std::array::from_fn(|number| match number {
            FRAME => buffer(frame(0, 0, [0.0; 2]), BufferUsages::UNIFORM), // shown as it is
            _ => buffer(vec![0; 16], BufferUsages::STORAGE),
        });
        let mut parts = vec![];
        for (entity, base, standard) in drawn {
            let place = buffer(part(Affine3A::IDENTITY, DVec3::ZERO, 0), BufferUsages::UNIFORM);
            let of = |number: usize| if number == PART { place.clone() } else { shared[number].clone() };
            let material = materials.add(ExtendedMaterial { base, extension: Blended(std::array::from_fn(of)) });
            commands.entity(entity).remove::<MeshMaterial3d<StandardMaterial>>().insert(MeshMaterial3d(material.clone()));
            parts.push(BlendedPart { entity, place, material, standard });
        }
        deformed.bypass_change_detection().set_blend(Some(Blend::default()));
        commands.entity(root).insert(BlendBuffers { shared, parts });
    }
}

/// Takes over what changes about the materials that were there before: other values, or another material.
fn follow_materials(
    mut blended: Query<&mut BlendBuffers>,
    shown: Query<&MeshMaterial3d<StandardMaterial>>,
    standards: Res<Assets<StandardMaterial>>,
    mut materials: ResMut<Assets<BlendMaterial>>,
    mut changes: MessageReader<AssetEvent<StandardMaterial>>,
    mut commands: Commands,
) {
    let changed: Vec<AssetId<StandardMaterial>> =
        changes.read().filter_map(|change| if let AssetEvent::Modified { id } = change { Some(*id) } else { None }).collect();
    for mut buffers in &mut blended {
        for part in &mut buffers.bypass_change_detection().parts {
            let other = shown.get(part.entity).ok().map(|other| other.0.clone());
            if other.is_none() && !changed.contains(&part.standard.id()) {
                continue;
            }
            if let Some(other) = other {
                if !standards.contains(&other) {
                    continue;
                }
                part.standard = other;
                // the engine draws with the material that came last
                let again = MeshMaterial3d(part.material.clone());
                commands.entity(part.entity).remove::<MeshMaterial3d<StandardMaterial>>().insert(again);
            }
            if let (Some(standard), Some(mut material)) = (standards.get(&part.standard), materials.get_mut(&part.material)) {
                material.base = standard.clone();
            }
        }
    }
}

/// Sends what is new to the GPU, and bounds the meshes for culling.
fn upload(
    mut deformed: Query<(&mut DeformedMesh, &BlendBuffers)>,
    mut buffers: ResMut<Assets<ShaderBuffer>>,
    mut materials: ResMut<Assets<BlendMaterial>>,
    mut commands: Commands,
) {
    for (mut deformed, blended) in &mut deformed {
        let deformed = deformed.bypass_change_detection();
        let count = deformed.rest().len();
        let DeformedMesh { blend: Some(blend), parts, .. } = deformed else { continue };
        if !std::mem::take(&mut blend.changed) {
            continue;
        }
        let mut send = |handle: &Handle<ShaderBuffer>, data: Vec<u8>| {
            if let Some(mut buffer) = buffers.get_mut(handle) {
                buffer.data = Some(data);
            }
        };
        let clusters = if blend.on { blend.transforms.len() / 24 } else { 0 };
        send(&blended.shared[FRAME], frame(count, clusters, blend.shares));
        if !blend.on {
            for part in parts.iter() {
                if let Ok(mut entity) = commands.get_entity(part.entity) {
                    entity.try_remove::<(NoAutoAabb, Aabb)>(); // the engine bounds the mesh again
                }
            }
            continue;
        }
        send(&blended.shared[TRANSFORMS], floats(&blend.transforms));
        if let Some(rows) = blend.rows.take() {
            send(&blended.shared[ROWS], bytes(&rows.rows, u32::to_le_bytes));
            let mut clusters = bytes(&rows.clusters, u16::to_le_bytes);
            clusters.resize(clusters.len().next_multiple_of(4), 0); // the shader reads two at once
            send(&blended.shared[CLUSTERS], clusters);
            send(&blended.shared[WEIGHTS], floats(&rows.weights));
            send(&blended.shared[GRADIENTS], floats(&rows.gradients));
            send(&blended.shared[OFFSETS], floats(&rows.offsets));
            for (part_of, drawn) in parts.iter().zip(&blended.parts) {
                send(&drawn.place, part(part_of.into_mesh.unwrap_or_default(), blend.centre, part_of.vertices.start));
                // bound again: buffers have other sizes
                materials.get_mut(&drawn.material).map(AssetMut::into_inner);
            }
        }
        for part in parts.iter() {
            let into = part.into_mesh.unwrap_or_default() * Affine3A::from_translation(blend.centre.as_vec3());
            let [low, high] = blend.bounds.map(Vec3A::from);
            let (middle, half) = ((low + high) / 2.0, (high - low) / 2.0);
            let half = into.matrix3.abs() * half;
            let bounds = Aabb { center: into.transform_point3a(middle), half_extents: half };
            if let Ok(mut entity) = commands.get_entity(part.entity) {
                entity.try_insert((bounds, NoAutoAabb));
            }
        }
    }
}

/// Gives the meshes the materials back that they had.
fn end(root: Entity, blended: &Query<&BlendBuffers>, commands: &mut Commands) {
    let Ok(buffers) = blended.get(root) else { return };
    for part in &buffers.parts {
        let Ok(mut entity) = commands.get_entity(part.entity) else { continue };
        entity.try_remove::<(MeshMaterial3d<BlendMaterial>, NoAutoAabb, Aabb)>();
        entity.try_insert(MeshMaterial3d(part.standard.clone()));
    }
    if let Ok(mut root) = commands.get_entity(root) {
        root.try_remove::<BlendBuffers>();
    }
}

fn on_blend_removed(
    removed: On<Remove, GpuBlend>,
    mut deformed: Query<&mut DeformedMesh>,
    blended: Query<&BlendBuffers>,
    mut commands: Commands,
) {
    if let Ok(mut deformed) = deformed.get_mut(removed.entity) {
        deformed.bypass_change_detection().set_blend(None);
    }
    end(removed.entity, &blended, &mut commands);
}

fn on_deformed_removed(removed: On<Remove, DeformedMesh>, blended: Query<&BlendBuffers>, mut commands: Commands) {
    end(removed.entity, &blended, &mut commands);
}
