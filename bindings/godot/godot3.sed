# The scripts are written for Godot 4. `sed -f godot3.sed` makes them scripts for Godot 3.
s/\bPackedVector3Array\b/PoolVector3Array/g
s/\bPackedInt32Array\b/PoolIntArray/g
s/\bPackedFloat32Array\b/PoolRealArray/g
s/\bPackedByteArray\b/PoolByteArray/g
s/\bTYPE_PACKED_VECTOR3_ARRAY\b/TYPE_VECTOR3_ARRAY/g
s/\bTYPE_PACKED_INT32_ARRAY\b/TYPE_INT_ARRAY/g
s/\bTYPE_PACKED_FLOAT32_ARRAY\b/TYPE_REAL_ARRAY/g
s/\bTYPE_FLOAT\b/TYPE_REAL/g
s/\b\(MeshInstance\|DirectionalLight\|Camera\)3D\b/\1/g
s/\bNode3D\b/Spatial/g
s/\bTransform3D\b/Transform/g
s/\bQuaternion(/Quat(/g
s/\.is_empty()/.empty()/g
s/\.reverse()/.invert()/g
s/\.instantiate()/.instance()/g
s/\.get_rotation_quaternion()/.get_rotation_quat()/g
s/\bSkeleton3D\b/Skeleton/g
s/@export var \(\w*\): NodePath/export(NodePath) var \1/
# poses of bones are relative to their rest
s/skeleton\.get_bone_pose(bone)/(skeleton.get_bone_rest(bone) * skeleton.get_bone_pose(bone))/
/set_bone_pose_position\|set_bone_pose_scale/d
s/set_bone_pose_rotation(bone, turn)/set_bone_pose(bone, skeleton.get_bone_rest(bone).affine_inverse() * Transform(Basis(turn).x * size.x, Basis(turn).y * size.y, Basis(turn).z * size.z, place))/
s/\bawait process_frame\b/yield(self, "idle_frame")/g
s|res://addons/hf/|res://hf/|g
# a global class in Godot 4
/^extends /a \
\
const HfSurface = preload("res://hf/hf_surface.gdns")
