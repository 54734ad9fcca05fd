# Posed vertices of an imported glTF as Godot 3 plays it: godot3-server --path PROJECT -s read_godot.gd
# PROJECT holds creature.glb (imported before), times.txt and clip.txt (the clip's name as Godot has it); posed.json is
# written there.
extends SceneTree

func find(node, kind):
	if node.is_class(kind):
		return node
	for child in node.get_children():
		var found = find(child, kind)
		if found:
			return found
	return null

func meshes(node, out):
	if node is MeshInstance:
		out.append(node)
	for child in node.get_children():
		meshes(child, out)

func _init():
	var scene = load("res://creature.glb").instance()
	get_root().add_child(scene)
	var player = find(scene, "AnimationPlayer")
	var file = File.new()
	file.open("res://times.txt", File.READ)
	var times = file.get_as_text().split(",")
	file.close()
	file.open("res://clip.txt", File.READ)
	var name = file.get_as_text()
	file.close()
	var found = []
	meshes(scene, found)
	var frames = []
	for time in times:
		var clip = player.get_animation(name)
		var skeleton = find(scene, "Skeleton")
		# the tracks by hand: a player moves nothing before the first idle frame
		for track in range(clip.get_track_count()):
			if clip.track_get_type(track) != Animation.TYPE_TRANSFORM:
				continue
			var value = clip.transform_track_interpolate(track, float(time))
			var local = Transform(Basis(value[1]).scaled(value[2]), value[0])
			var path = clip.track_get_path(track)
			if path.get_subname_count() > 0 and skeleton:
				skeleton.set_bone_pose(skeleton.find_bone(path.get_subname(0)), local)
			else:
				scene.get_node(NodePath(str(path).split(":")[0])).transform = local
		var points = []
		for instance in found:
			var skin = instance.skin
			for s in range(instance.mesh.get_surface_count()):
				var arrays = instance.mesh.surface_get_arrays(s)
				var count = arrays[Mesh.ARRAY_VERTEX].size()
				for v in range(count):
					var p = Vector3()
					for k in range(4):
						var w = arrays[Mesh.ARRAY_WEIGHTS][4 * v + k]
						var bind = int(arrays[Mesh.ARRAY_BONES][4 * v + k])
						if w == 0:
							continue
						var bone = skin.get_bind_bone(bind)
						if skin.get_bind_name(bind) != "":
							bone = skeleton.find_bone(skin.get_bind_name(bind))
						p += w * (skeleton.get_bone_global_pose(bone) * skin.get_bind_pose(bind)).xform(arrays[Mesh.ARRAY_VERTEX][v])
					p = skeleton.get_global_transform().xform(p) if skeleton.is_inside_tree() else p
					points.append(p.x)
					points.append(p.y)
					points.append(p.z)
		frames.append(points)
	file.open("res://posed.json", File.WRITE)
	file.store_string(to_json({"frames": frames}))
	file.close()
	quit()
