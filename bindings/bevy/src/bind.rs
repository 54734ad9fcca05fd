//! Makes the surface of a deformer from the meshes below it, and gives the meshes back.
use crate::deformed::{DeformedMesh, Part};
use crate::shading::Shading;
use crate::{DeformError, DeformHandle, Deformer, Places, place_in};
use bevy::asset::RenderAssetUsages;
use bevy::ecs::entity::EntityHashMap;
use bevy::ecs::system::SystemParam;
use bevy::log::warn;
use bevy::math::{Affine3A, Vec3A};
use bevy::mesh::skinning::{SkinnedMesh, SkinnedMeshInverseBindposes};
use bevy::mesh::{PrimitiveTopology, VertexAttributeValues};
use bevy::prelude::*;
use hf::raw::{HF_ERROR_INVALID_ARGUMENT, HF_ERROR_OUT_OF_RANGE, HF_NO_INDEX};

/// What a deformer reads of the entities below it.
#[derive(SystemParam)]
pub(crate) struct Below<'w, 's> {
    children: Query<'w, 's, &'static Children>,
    /// handles and other deformers are no parts of the surface
    apart: Query<'w, 's, (), Or<(With<Deformer>, With<DeformHandle>)>>,
    shown: Query<'w, 's, (&'static Mesh3d, Option<&'static SkinnedMesh>)>,
    places: Places<'w, 's>,
    skins: Option<Res<'w, Assets<SkinnedMeshInverseBindposes>>>,
    names: Query<'w, 's, &'static Name>,
}

/// All meshes of a deformer, one behind the other.
#[derive(Default)]
struct Soup {
    positions: Vec<f32>,
    triangles: Vec<u32>,
    normals: Vec<Vec3>,
    tangents: Vec<Vec3>,
    parts: Vec<(Part, Mesh)>,
    /// of all skins
    joints: Vec<Entity>,
    /// four joints of each vertex, and their weights
    influences: Vec<u32>,
    weights: Vec<f32>,
}

/// The joints of the skins below a deformer, and the skeleton that they were when it was bound.
pub(crate) struct Joints {
    pub(crate) entities: Vec<Entity>,
    pub(crate) skeleton: hf::Skeleton,
}

pub(crate) fn refuse(code: i32, message: &str) -> hf::Error {
    hf::Error { code, message: message.into(), function: String::new(), index: None }
}

pub(crate) fn bind(
    new: Query<(Entity, &Deformer), (Without<DeformedMesh>, Without<DeformError>)>,
    below: Below,
    mut meshes: ResMut<Assets<Mesh>>,
    mut commands: Commands,
) {
    for (root, deformer) in &new {
        let made = below.collect(root, &meshes).and_then(|soup| match soup {
            Some(soup) => {
                let options = hf::SurfaceOptions { links: deformer.links, ..deformer.surface };
                let surface = hf::Surface::new(&soup.positions, &soup.triangles, &options)?;
                let pose = hf::Pose::new(&surface, &deformer.pose)?;
                Ok(Some((surface, pose, soup)))
            }
            None => Ok(None), // in another frame
        });
        match made {
            Ok(Some((surface, pose, soup))) => {
                let joints = below.skeleton(root, &soup).and_then(|made| {
                    made.inspect_err(|error| warn!("deformer {root}: handles are proposed without its skeleton: {error}")).ok()
                });
                let shading = Shading::new(soup.positions.as_chunks().0, &soup.triangles, soup.normals, soup.tangents);
                let mut parts = vec![];
                for (mut part, mesh) in soup.parts {
                    // a mesh of its own: other entities may show the same one
                    part.shown = meshes.add(mesh);
                    commands.entity(part.entity).insert(Mesh3d(part.shown.clone())).remove::<SkinnedMesh>();
                    parts.push(part);
                }
                commands.entity(root).insert(DeformedMesh::new(parts, surface, pose, soup.positions, shading, joints));
            }
            Ok(None) => {}
            Err(error) => {
                warn!("deformer {root}: {error}");
                commands.entity(root).insert(DeformError(error));
            }
        }
    }
}

impl Below<'_, '_> {
    /// The meshes of an entity and of its descendants; `None` as long as there is none or one is not loaded.
    fn collect(&self, root: Entity, meshes: &Assets<Mesh>) -> hf::Result<Option<Soup>> {
        let (mut stack, mut soup, mut found) = (vec![root], Soup::default(), false);
        while let Some(entity) = stack.pop() {
            if let Ok(below) = self.children.get(entity) {
                stack.extend(below.iter().rev().filter(|below| !self.apart.contains(*below)));
            }
            let Ok((mesh, skin)) = self.shown.get(entity) else { continue };
            let Some(source) = meshes.get(&mesh.0) else { return Ok(None) };
            found = true;
            let mut joints = None;
            if let Some(skin) = skin {
                joints = self.joints(skin, root);
                if joints.is_none() {
                    return Ok(None);
                }
            }
            let place = place_in(&self.places, entity, root).unwrap_or_default();
            let first = soup.positions.len() / 3;
            soup.take(entity, place, source, joints.as_deref()).map_err(|mut error| {
                error.message = format!("mesh of {entity}: {}", error.message);
                error
            })?;
            if let Some((part, _)) = soup.parts.last_mut().filter(|(part, _)| part.entity == entity) {
                (part.original, part.skin) = (mesh.0.clone(), skin.cloned());
            }
            soup.take_skin(first, source, skin.map_or(&[], |skin| &skin.joints));
        }
        Ok(found.then_some(soup))
    }

    /// The skeleton of all skins, in the space of `root`; `None`: there is no skin, or a joint has no place.
    fn skeleton(&self, root: Entity, soup: &Soup) -> Option<hf::Result<Joints>> {
        let numbers: EntityHashMap<u32> = soup.joints.iter().enumerate().map(|(number, &joint)| (joint, number as u32)).collect();
        let (mut parents, mut rest, mut names) = (vec![], vec![], vec![]);
        for &joint in &soup.joints {
            let (mut above, mut place) = (joint, place_in(&self.places, joint, root)?);
            let parent = loop {
                let Some(parent) = self.places.get(above).ok().and_then(|(_, _, parent)| parent) else { break HF_NO_INDEX };
                above = parent.parent();
                if let Some(&number) = numbers.get(&above) {
                    place = place_in(&self.places, above, root)?.inverse() * place;
                    break number;
                }
            };
            let (size, turn, at) = place.to_scale_rotation_translation();
            parents.push(parent);
            rest.extend([at.to_array().as_slice(), &turn.to_array(), &size.to_array()].concat());
            names.push(self.names.get(joint).map_or("", |name| name.as_str()));
        }
        let skin = hf::Skin {
            positions: Some(&soup.positions),
            triangles: Some(&soup.triangles),
            joints: Some(&soup.influences),
            weights: Some(&soup.weights),
            ..default()
        };
        let options = hf::SkeletonOptions { skin: Some(skin), ..default() };
        let made = (!parents.is_empty()).then(|| hf::Skeleton::new(Some(&names), &parents, &rest, &options))?;
        Some(made.map(|skeleton| Joints { entities: soup.joints.clone(), skeleton }))
    }

    /// A joint's matrix takes a vertex to where the skin shows it in the space of `root`. `None`: not loaded yet.
    fn joints(&self, skin: &SkinnedMesh, root: Entity) -> Option<Vec<Mat4>> {
        let inverse = self.skins.as_ref()?.get(&skin.inverse_bindposes)?;
        let matrix = |(&joint, &inverse): (&Entity, &Mat4)| Some(Mat4::from(place_in(&self.places, joint, root)?) * inverse);
        skin.joints.iter().zip(inverse.iter()).map(matrix).collect()
    }
}

impl Soup {
    /// Adds the joints and weights of the vertices from `first` on. Those without a skin have weights of 0.
    fn take_skin(&mut self, first: usize, source: &Mesh, joints: &[Entity]) {
        let count = self.positions.len() / 3 - first;
        let (from, to) = (self.weights.len(), 4 * (first + count));
        self.weights.resize(to, 0.0);
        self.influences.resize(to, 0);
        let (Some(VertexAttributeValues::Uint16x4(of)), Some(VertexAttributeValues::Float32x4(weights))) =
            (source.attribute(Mesh::ATTRIBUTE_JOINT_INDEX), source.attribute(Mesh::ATTRIBUTE_JOINT_WEIGHT))
        else {
            return;
        };
        let numbers: Vec<u32> = joints
            .iter()
            .map(|joint| {
                let known = self.joints.iter().position(|known| known == joint);
                known.unwrap_or_else(|| (self.joints.push(*joint), self.joints.len() - 1).1) as u32
            })
            .collect();
        let slots = of.as_flattened().iter().zip(weights.as_flattened());
        for (at, (&joint, &weight)) in slots.enumerate().take(4 * count) {
            let Some(&number) = numbers.get(joint as usize) else { continue };
            (self.influences[from + at], self.weights[from + at]) = (number, weight.max(0.0));
        }
    }

    /// Adds a mesh. Meshes that are no list of triangles stay as they are.
    fn take(&mut self, entity: Entity, place: Affine3A, source: &Mesh, joints: Option<&[Mat4]>) -> hf::Result<()> {
        if source.primitive_topology() != PrimitiveTopology::TriangleList {
            return Ok(());
        }
        let into_mesh = place.inverse();
        if !(place.is_finite() && into_mesh.is_finite()) {
            return Err(refuse(HF_ERROR_INVALID_ARGUMENT, "its transform must be finite and have a scale other than 0"));
        }
        let Ok(attributes) = source.try_attributes() else {
            return Err(refuse(HF_ERROR_INVALID_ARGUMENT, "it is no longer in main memory; its asset_usage needs MAIN_WORLD"));
        };
        // without what moves vertices: they follow handles instead
        let mut mesh = Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::default());
        for (attribute, values) in attributes {
            if ![Mesh::ATTRIBUTE_JOINT_INDEX.id, Mesh::ATTRIBUTE_JOINT_WEIGHT.id].contains(&attribute.id) {
                mesh.insert_attribute(*attribute, values.clone());
            }
        }
        let Some(VertexAttributeValues::Float32x3(positions)) = mesh.attribute(Mesh::ATTRIBUTE_POSITION) else {
            return Err(refuse(HF_ERROR_INVALID_ARGUMENT, "it needs positions of three floats"));
        };
        let (mut positions, count) = (positions.clone(), positions.len());
        let mut corners: Vec<u32> = match source.indices() {
            Some(indices) => indices.iter().map(|at| at as u32).collect(),
            None => (0..count as u32).collect(),
        };
        corners.truncate(corners.len() / 3 * 3);
        if let Some(wrong) = corners.iter().position(|&at| at as usize >= count) {
            let index = Some((wrong / 3) as u32);
            return Err(hf::Error { index, ..refuse(HF_ERROR_OUT_OF_RANGE, "a triangle names a vertex that it does not have") });
        }
        if let Some(indices) = source.indices() {
            mesh.insert_indices(indices.clone());
        }
        if !matches!(mesh.attribute(Mesh::ATTRIBUTE_NORMAL), Some(VertexAttributeValues::Float32x3(_))) {
            mesh.compute_normals();
        }
        let Some(VertexAttributeValues::Float32x3(normals)) = mesh.attribute(Mesh::ATTRIBUTE_NORMAL) else {
            return Err(refuse(HF_ERROR_INVALID_ARGUMENT, "it needs normals of three floats"));
        };
        let mut normals = normals.clone();
        let mut tangents = match mesh.attribute(Mesh::ATTRIBUTE_TANGENT) {
            Some(VertexAttributeValues::Float32x4(tangents)) => Some(tangents.clone()),
            _ => None,
        };
        if let Some(joints) = joints {
            bake(&mut positions, &mut normals, tangents.as_deref_mut(), source, joints, into_mesh);
            if let Some(tangents) = &tangents {
                mesh.insert_attribute(Mesh::ATTRIBUTE_TANGENT, tangents.clone());
            }
            mesh.insert_attribute(Mesh::ATTRIBUTE_POSITION, positions.clone());
            mesh.insert_attribute(Mesh::ATTRIBUTE_NORMAL, normals.clone());
        }
        let first = self.positions.len() / 3;
        let same = place == Affine3A::IDENTITY;
        let in_space = |p: &[f32; 3]| if same { *p } else { place.transform_point3(Vec3::from_array(*p)).to_array() };
        self.positions.extend(positions.iter().flat_map(in_space));
        // normals turn by the inverse transpose of what moves points
        let turn = into_mesh.matrix3.transpose();
        self.normals.extend(normals.iter().map(|n| Vec3::from(turn * Vec3A::from_array(*n)).normalize_or_zero()));
        self.tangents.extend((0..count).map(|at| {
            let tangent = tangents.as_ref().map_or(Vec3A::ZERO, |tangents| Vec3A::from_slice(&tangents[at]));
            Vec3::from(place.matrix3 * tangent).normalize_or_zero()
        }));
        // a mirror turns triangles over
        let turned = place.matrix3.determinant() < 0.0;
        for corner in corners.chunks_exact(3) {
            let [a, b, c] = [corner[0], corner[1], corner[2]].map(|at| at + first as u32);
            self.triangles.extend(if turned { [a, c, b] } else { [a, b, c] });
        }
        let part = Part {
            entity,
            vertices: first..first + count,
            original: default(),
            skin: None,
            shown: default(),
            into_mesh: (!same).then_some(into_mesh),
            rest_positions: positions,
            rest_normals: normals,
            rest_tangents: tangents,
        };
        self.parts.push((part, mesh));
        Ok(())
    }
}

/// Moves vertices to where their skin shows them, in the space of the mesh's entity. Normals and tangents turn
/// as for joints that are rigid.
fn bake(
    positions: &mut [[f32; 3]],
    normals: &mut [[f32; 3]],
    mut tangents: Option<&mut [[f32; 4]]>,
    source: &Mesh,
    joints: &[Mat4],
    into_mesh: Affine3A,
) {
    let (Some(VertexAttributeValues::Uint16x4(of)), Some(VertexAttributeValues::Float32x4(weights))) =
        (source.attribute(Mesh::ATTRIBUTE_JOINT_INDEX), source.attribute(Mesh::ATTRIBUTE_JOINT_WEIGHT))
    else {
        return;
    };
    for (at, (((p, n), of), weights)) in positions.iter_mut().zip(normals).zip(of).zip(weights).enumerate() {
        let mut blend = Mat4::ZERO;
        for (&joint, &weight) in of.iter().zip(weights) {
            if let Some(joint) = joints.get(joint as usize) {
                blend += *joint * weight;
            }
        }
        let blend = Mat4::from(into_mesh) * blend;
        *p = blend.transform_point3(Vec3::from_array(*p)).to_array();
        *n = blend.transform_vector3(Vec3::from_array(*n)).normalize_or_zero().to_array();
        if let Some(t) = tangents.as_mut().and_then(|tangents| tangents.get_mut(at)) {
            let turned = blend.transform_vector3(Vec3::from_slice(t)).normalize_or_zero();
            *t = turned.extend(t[3]).to_array();
        }
    }
}

/// A deformer is new or has other options: it is bound again.
pub(crate) fn on_insert(inserted: On<Insert, Deformer>, mut commands: Commands) {
    commands.entity(inserted.entity).try_remove::<(DeformedMesh, DeformError)>();
}

/// The meshes go back to what they were, but for entities that were given another mesh since.
pub(crate) fn on_remove(removed: On<Remove, DeformedMesh>, deformed: Query<&DeformedMesh>, shown: Query<&Mesh3d>, mut commands: Commands) {
    let Ok(deformed) = deformed.get(removed.entity) else { return };
    for part in deformed.parts.iter().filter(|part| shown.get(part.entity).is_ok_and(|mesh| mesh.0 == part.shown)) {
        let Ok(mut entity) = commands.get_entity(part.entity) else { continue };
        entity.try_insert(Mesh3d(part.original.clone()));
        if let Some(skin) = &part.skin {
            entity.try_insert(skin.clone());
        }
    }
}

/// Without its deformer, a mesh follows nothing.
pub(crate) fn on_deformer_removed(removed: On<Remove, Deformer>, mut commands: Commands) {
    commands.entity(removed.entity).try_remove::<(DeformedMesh, DeformError)>();
}
