# The golden scenes through HfSurface, then a glb imported by Godot and posed: godot --headless --path PROJECT -s test.gd
# For Godot 3 bindings/godot/godot3.sed changes some words.
# Positions and fields are single precision here, so figures agree to 3e-6 of the largest. Steps of calls that the class
# does not offer are counted and left out; NOT_OFFERED names them.
extends SceneTree

const Deformer = preload("res://addons/hf/hf_deformer.gd")
const Player = preload("res://addons/hf/hf_retarget.gd")
const Host = preload("res://host.gd")
var meshes = {}
var failed = 0
var left_out = 0
var done = 0
var wrong = 0

func read(path):
	var result = Host.json(path)
	if result == null:
		printerr("cannot read ", path)
		failed += 1
		return {}
	return result

func number(v):
	return {"nan": NAN, "inf": INF, "-inf": -INF}.get(v, v) if typeof(v) == TYPE_STRING else v

func list(step, key, kept):
	var v = step.get(key)
	if typeof(v) == TYPE_STRING:
		return kept.get(v)
	if v == null or v.is_empty() or typeof(v[0]) == TYPE_ARRAY:
		return v
	var out = []
	for x in v:
		out.append(number(x))
	return out

# steps of calls that the class does not offer
const NOT_OFFERED = ["graph", "weights", "transfer", "preview", "clone_vectors", "transfer_weights", "mirror"]

var methods = {} # of distances, by the name of the step that chose it

func options_of(step):
	var out = {}
	for key in step.get("options", {}):
		var v = step.options[key]
		out[key] = 3 if typeof(v) == TYPE_STRING and v == "HF_OPERATOR_COTANGENT" else v
	return out

# [offered, result, surface asked]; [] for an unknown step
func run(step, objects, kept):
	var on = objects.get(step.get("on"))
	match step["do"]:
		"surface":
			var made = HfSurface.new()
			var mesh = meshes[step.mesh] if step.mesh != null else {"positions": null, "triangles": null}
			var positions = mesh.positions.duplicate() if mesh.positions != null else null
			var triangles = mesh.triangles.duplicate() if mesh.triangles != null else null
			for key in step.get("positions", {}):
				positions[int(key)] = number(step.positions[key])
			for key in step.get("triangles", {}):
				triangles[int(key)] = step.triangles[key]
			if step.has("no_triangles"):
				triangles = []
			var factor = kept.get(step.get("factor"))
			if factor != null and step.has("damage"):
				factor = PackedByteArray(factor)
				factor[step.damage] = factor[step.damage] ^ 1
			if step.has("tags"):
				return [false, null, null]
			var result
			if step.has("faces"):
				result = made.create_faces(positions, step.faces.offsets, step.faces.corners, options_of(step), factor)
			else:
				result = made.create(positions, triangles, options_of(step), factor)
			if result != null:
				objects[step["as"]] = made
			return [true, result, made]
		"solver", "pose":
			var made = shares(on)
			var options = options_of(step)
			var result = made.solver_create(options) if step["do"] == "solver" else made.pose_create(options)
			if result != null:
				objects[step["as"]] = made
			return [true, result, made]
		"clone":
			var made = HfSurface.new()
			var result = made.clone_from(on)
			if result != null:
				objects[step["as"]] = made
			return [true, result, made]
		"dispose": return [true, on.dispose(), on]
		"edit_surface": # in place, on a surface that shares the mesh
			var made = shares(on)
			var result = null
			if step.has("cut_edges"):
				result = made.edit_cut(step.cut_edges)
			elif step.has("removed_triangles"):
				result = made.edit_patch(step.removed_triangles, list(step, "new_positions", kept), step.get("new_triangles"))
			else:
				result = made.edit(list(step, "vertices", kept), list(step, "stiffness", kept), list(step, "links", kept),
					list(step, "removed_links", kept))
			if result != null:
				objects[step["as"]] = made
			return [true, result, made]
		"cut_surface":
			var made = shares(on)
			var rows = made.edit_line(step.places)
			var numbers = []
			for row in (rows if rows != null else []):
				numbers += [row.triangle, row.a, row.b, row.c]
				for corner in ["a", "b", "c"]:
					numbers += [row[corner + "0"], row[corner + "1"], row[corner + "2"]]
			if rows != null:
				objects[step["as"]] = made
			return [true, PackedFloat32Array(numbers) if rows != null else null, made]
		"cuts":
			var corners = []
			for row in on.cuts():
				corners += [row.triangle, row.corner, row.vertex, row.copied]
			return [true, PackedFloat32Array(corners), on]
		"move_to": return [true, on.move_to(objects.get(step.to)), on]
		"add_sites": return [true, on.add_sites(list(step, "vertices", kept), list(step, "values", kept),
			list(step, "stiffness", kept), list(step, "radii", kept), list(step, "places", kept)), on]
		"add_site": return [true, on.add_site(step.vertex, number(step.get("value", 0))), on]
		"remove_sites": return [true, on.remove_sites(list(step, "sites", kept)), on]
		"move_sites": return [true, on.move_sites(list(step, "sites", kept), list(step, "vertices", kept)), on]
		"set_values": return [true, on.set_values(list(step, "sites", kept), list(step, "values", kept)), on]
		"edit": return [true, on.edit_sites(list(step, "remove", kept), list(step, "move", kept), list(step, "move_to", kept),
			list(step, "set", kept), list(step, "set_values", kept), list(step, "add", kept), list(step, "add_values", kept)), on]
		"certify": return [true, on.certify(number(step.get("tolerance", 0))), on]
		"region":
			var made = shares(on)
			var result = made.region_create(list(step, "positions", kept), options_of(step).get("base", 0))
			if result != null:
				objects[step["as"]] = made
			return [true, result, made]
		"region_edit": return [true, on.region_edit(list(step, "add", kept), list(step, "remove", kept), step.get("rings", 0),
			list(step, "curve", kept), 0, 0, step.get("curve_kind", 0)), on]
		"region_info": return [true, on.region_info(), on]
		"region_vertices": return [true, on.region_vertices(step.get("list", 0)), on]
		"region_curve": return [true, on.region_curve(), on]
		"record_region": return [true, on.region_record(), on]
		"undo_region": return [true, on.region_undo(), on]
		"redo_region": return [true, on.region_redo(), on]
		"morph":
			if kept.get("detail") == step.on:
				return [true, on.detail_morph(number(step.weight)), on]
			return [true, on.region_morph(number(step.weight)), on]
		"detail": # kept by the surface of the target
			var target = objects[step.target]
			var result = target.detail_from(objects[step.source])
			if result != null:
				objects[step["as"]] = target
				kept["detail"] = step["as"]
			return [true, result, target]
		"skin":
			if step.has("error"):
				return [true, on.skin_weights(step.influence_count), on]
			var joints = on.skin_joints()
			var bones = on.skin_bones(step.influence_count)
			expect(joints.size() >= 2 and joints[0].has("pivot_x"), "joints of a skin")
			expect(bones.size() == step.influence_count * on.report().vertex_count, "bones of a skin")
			for bone in bones:
				expect(bone < joints.size(), "a bone that is a joint")
			return [true, on.skin_weights(step.influence_count), on]
		"record": return [true, on.record(), on]
		"undo": return [true, on.undo(), on]
		"redo": return [true, on.redo(), on]
		"solve", "solve_f32": return [true, on.solve(), on]
		"solve_at": return [true, on.solve_at(list(step, "vertices", kept)), on]
		"report": return [true, on.report(), on]
		"statistics": return [true, on.statistics(), on]
		"surface_statistics": return [true, on.surface_statistics(), on]
		"surface_info": return [true, on.surface_info(), on]
		"solver_info": return [true, on.solver_info(), on]
		"pose_info": return [true, on.pose_info(), on]
		"components":
			var found = on.components()
			return [true, PackedFloat32Array(Array(found)) if found != null else null, on]
		"cast_ray":
			var hit = on.cast_ray(list(step, "origin", kept), list(step, "direction", kept), list(step, "positions", kept),
				step.get("front_only", 0))
			if hit == null or hit.is_empty():
				return [true, hit if hit == null else PackedFloat32Array([0]), on]
			return [true, PackedFloat32Array([1, hit.triangle, hit.vertex, hit.weight_0, hit.weight_1, hit.weight_2, hit.x, hit.y,
				hit.z, hit.distance]), on]
		"find_vertex":
			var nearest = on.find_vertex(list(step, "point", kept), list(step, "positions", kept))
			return [true, PackedFloat32Array([nearest.vertex, nearest.distance]) if nearest != null else null, on]
		"save":
			var bytes = on.save(step.get("field_kind", 0))
			if bytes != null:
				kept[step["as"]] = bytes
			return [true, bytes, on]
		"add_handles":
			var layer = step.get("layer", 0)
			var in_place = step.get("in_place", false)
			if step.has("points"):
				return [true, on.add_handles_at(list(step, "points", kept), list(step, "radii", kept), layer, in_place), on]
			return [true, on.add_handles(step.regions, layer, in_place), on]
		"add_handle_at": return [true, on.add_handle_at(list(step, "point", kept), number(step.radius)), on]
		"set_transform": return [true, on.set_transform(step.handle, list(step, "rotation", kept), list(step, "translation",
			kept)), on]
		"deform_f32": return [true, on.deform(), on]
		"remove_handles": return [true, on.remove_handles(list(step, "handles", kept)), on]
		"set_transforms": return [true, on.set_transforms(list(step, "handles", kept), list(step, "rotations", kept),
			list(step, "translations", kept)), on]
		"handle_field": return [true, on.handle_field(step.handle), on]
		"handle_info": return [true, on.handle_info(step.handle), on]
		"handle_place":
			var info = on.handle_info(step.handle)
			if info == null:
				return [true, null, on]
			return [true, PackedFloat32Array([info.rotation_x, info.rotation_y, info.rotation_z, info.rotation_w,
				info.translation_x, info.translation_y, info.translation_z]), on]
		"deform": return [true, on.deform(options_of(step)), on]
		"geodesics", "flow": # made with the first call here
			if step.has("error"):
				return [false, null, null]
			var made = shares(on)
			objects[step["as"]] = made
			methods[step["as"]] = options_of(step).get("method", 0)
			return [true, true, made]
		"distance": return [true, on.distance(list(step, "sources", kept), methods.get(step["on"], 0)), on]
		"path":
			var path = on.find_path(list(step, "from", kept), list(step, "to", kept), methods.get(step["on"], 0))
			return [true, points_of(step, path), on]
		"map": return [true, on.map_around(list(step, "centre", kept), step.get("radius", 0), methods.get(step["on"], 0)), on]
		"levels": return [true, on.space_levels(list(step, "field", kept), step.count,
			{"HF_LEVELS_AREA": 1}.get(step.spacing, 0)), on]
		"isolines":
			var lines = on.trace_isolines(list(step, "field", kept), list(step, "levels", kept))
			return [true, points_of(step, lines), on]
		"critical": return [true, column(on.find_critical_points(list(step, "field", kept)), "index"), on]
		"propose":
			var places = column(on.propose_handles(), "vertex")
			if places != null:
				places = Array(places)
				places.sort()
				places = PackedFloat32Array(places)
			return [true, places, on]
		"extremities":
			var tips = column(on.find_extremities(), "vertex")
			if tips != null:
				tips = Array(tips)
				tips.sort()
				tips = PackedFloat32Array(tips)
			return [true, tips, on]
		"direction":
			var made = shares(on)
			var result = made.direction_create(step.get("options", {}).get("degree", 1))
			if result != null:
				objects[step["as"]] = made
			return [true, result, made]
		"quads", "update_quads":
			var options = step.get("options", {}).duplicate()
			for key in options:
				options[key] = number(options[key])
			if step.has("edge_length"):
				options["edge_length"] = number(step.edge_length)
			var given = [options, step.get("crease_edges"), step.get("guide_vertices"), list(step, "guide_vectors", kept),
				list(step, "guide_weights", kept), list(step, "symmetry_plane", kept), list(step, "irregular_points", kept),
				step.get("irregular_valences"), list(step, "irregular_directions", kept)]
			if step["do"] == "update_quads":
				var updated = on.callv("quads_update", given)
				return [true, on.quads_positions() if updated != null else null, on]
			var made = shares(on)
			var result = made.callv("quads_create", given)
			if result != null:
				objects[step["as"]] = made
			return [true, result, made]
		"add_vectors": return [true, on.direction_add_sites(list(step, "vertices", kept), list(step, "vectors", kept)), on]
		"remove_vectors": return [true, on.direction_remove_sites(list(step, "sites", kept)), on]
		"move_vectors": return [true, on.direction_move_sites(list(step, "sites", kept), list(step, "vertices", kept)), on]
		"set_vectors": return [true, on.direction_set_vectors(list(step, "sites", kept), list(step, "vectors", kept)), on]
		"rotate": return [true, on.direction_rotate_sites(list(step, "sites", kept), list(step, "angles", kept)), on]
		"record_vectors": return [true, on.direction_record(), on]
		"undo_vectors": return [true, on.direction_undo(), on]
		"redo_vectors": return [true, on.direction_redo(), on]
		"vectors":
			if step.has("error"):
				return [false, null, null]
			return [true, on.direction_vectors(), on]
		"directions": return [true, on.direction_solve(), on]
		"singularities": return [true, column(on.direction_singularities(), "index"), on]
		"quads_info":
			return [true, on.quads_info(), on]
		"quad_mesh":
			var faces = on.quads_faces()
			var info = on.quads_info()
			if info != null:
				expect(faces.size() == info.face_count and faces[0].size() == 4, "faces of a quad mesh")
			return [true, on.quads_positions(), on]
		"streamlines":
			var lines = on.streamlines(list(step, "field", kept), step.get("count"), list(step, "seeds", kept))
			return [true, points_of(step, lines), on]
	return []

# A surface of its own on the same factor; a stale one gives a stale one.
func shares(on):
	var made = HfSurface.new()
	made.share_from(on)
	return made

# A column of a list of dictionaries.
func column(rows, name):
	if rows == null:
		return null
	var out = []
	for row in rows:
		out.append(row[name])
	return PackedFloat32Array(out)

# All points of polylines one after the other.
func points_of(step, lines):
	if lines == null:
		return null
	expect(not step.has("lines") or lines.size() == step.lines, "%d lines" % lines.size())
	var out = []
	for line in lines:
		out += Array(line)
	return PackedVector3Array(out)

func flat(a):
	if typeof(a) != TYPE_PACKED_VECTOR3_ARRAY:
		return a
	var out = []
	for v in a:
		out += [v.x, v.y, v.z]
	return out

func compare(a, wanted):
	var sum = 0.0
	var weighted = 0.0
	var most = 0.0
	for i in a.size():
		if is_nan(a[i]) or is_inf(a[i]):
			return "not finite"
		sum += a[i]
		weighted += a[i] * (i % 7 + 1)
		most = max(most, abs(a[i]))
	var t = wanted.get("tolerance", 0.0) + 3e-6 * max(1.0, most)
	if wanted.has("count") and a.size() != wanted["count"]:
		return "count %d" % a.size()
	if wanted.has("sum") and abs(sum - wanted["sum"]) > t * a.size():
		return "sum is %f, not %f" % [sum, wanted["sum"]]
	if wanted.has("weighted") and abs(weighted - wanted["weighted"]) > 7 * t * a.size():
		return "weighted"
	var values = wanted.get("values", [])
	for k in values.size():
		if abs(a[wanted["at"][k]] - values[k]) > t:
			return "value at %d" % wanted["at"][k]
	return ""

# What a step that is left out would make has no steps either.
func leave_out(step, kept):
	left_out += 1
	if step.has("as"):
		kept["left out"] = kept.get("left out", []) + [step["as"]]
	return ""

func check(step, objects, kept):
	if NOT_OFFERED.has(step["do"]) or kept.get("left out", []).has(step.get("on")):
		return leave_out(step, kept)
	if step.has("on") and objects.get(step.on) == null:
		return "there is no " + step.on
	var answer = run(step, objects, kept)
	if answer.is_empty():
		return "unknown step"
	if not answer[0]:
		return leave_out(step, kept)
	done += 1
	if step.has("error"):
		wrong += 1
	var result = answer[1]
	var error = answer[2].get_error()
	if result == null:
		if error.get("name") != step.get("error"):
			return "raised " + str(error)
		if step.has("index") and error["index"] != step["index"]:
			return "index " + str(error)
		return ""
	if step.has("error"):
		return "did not fail with " + step.error
	var wanted = step.get("expect", {})
	if typeof(result) == TYPE_DICTIONARY:
		for key in wanted:
			if key != "tolerance" and abs(result[key] - wanted[key]) > max(1e-6, wanted.get("tolerance", 0)):
				return key + " is " + str(result[key])
	elif typeof(result) == TYPE_FLOAT and step.has("numbers"):
		if result != step.numbers[0]:
			return "number " + str(result)
	elif typeof(result) == TYPE_PACKED_INT32_ARRAY:
		if step.has("numbers") and step["do"] != "edit":
			for i in result.size():
				if result[i] != step.numbers[i]:
					return "numbers " + str(result)
	elif typeof(result) == TYPE_PACKED_FLOAT32_ARRAY or typeof(result) == TYPE_PACKED_VECTOR3_ARRAY:
		var values = flat(result)
		if not wanted.is_empty():
			var message = compare(values, wanted)
			if message != "":
				return message
		if step.has("same_as") and str(Array(values)) != str(Array(kept[step.same_as])):
			return "differs from " + step.same_as
		if step.has("keep"):
			kept[step.keep] = values
	return ""

func golden(path):
	for scene in read(path).get("scenes", []):
		var objects = {}
		var kept = {}
		var place = 0
		for step in scene.steps:
			var message = check(step, objects, kept)
			if message != "":
				failed += 1
				print("FAILED ", scene.name, ", step ", place, " (", step["do"], "): ", message)
			place += 1
		print(scene.name, ": ", place, " steps")

# A step that the interpreter does not know fails, also where a failure is expected.
func unknown_steps():
	for step in [{"do": "nonsense"}, {"do": "nonsense", "error": "HF_ERROR_EMPTY"}, {"do": "solve", "on": "nobody", "error": "HF_ERROR_EMPTY"}]:
		expect(check(step, {}, {}) != "", "an unknown step passes: " + str(step))

func farthest(a, b):
	var most = 0.0 if a.size() == b.size() else INF
	for i in a.size():
		most = max(most, a[i].distance_to(b[i]) if typeof(a[i]) == TYPE_VECTOR3 else abs(a[i] - b[i]))
	return most

func made_of(mesh, triangles):
	var made = HfSurface.new()
	made.create(mesh, triangles, {"weld": 1})
	made.add_sites([0, 140, 200], [0, 1, 0.25])
	return made

# Edits happen in place: the solver, what it has recorded and the pose move along, and surfaces that share the mesh stay.
func edited():
	var torus = meshes["torus"]
	var s = made_of(torus.positions, torus.triangles)
	var plain = HfSurface.new()
	plain.clone_from(s)
	var before = s.solve()
	s.record()
	s.add_site(70, 0.5)
	expect(s.edit([3, 4, 5], [100, 100, 0.5]) == true, "edit: " + str(s.get_error()))
	expect(s.stiffness()[3] == 100 and s.stiffness()[5] == 0.5 and s.stiffness()[6] == 1 and plain.stiffness()[3] == 1, "stiffness of vertices")
	expect(s.statistics()["factorisation_count"] == 0 and farthest(plain.solve(), before) == 0, "a surface that shares the mesh stays")
	var with_site = s.solve()
	s.undo()
	var same = made_of(torus.positions, torus.triangles)
	same.edit([3, 4, 5], [100, 100, 0.5])
	expect(farthest(s.solve(), same.solve()) < 1e-6 and farthest(s.solve(), before) > 1e-3, "what was recorded before an edit moves along")
	s.redo()
	expect(farthest(s.solve(), with_site) < 1e-6, "redo")
	s.undo()
	expect(s.edit([3, 4, 5], [1, 1, 1]) == true and farthest(s.solve(), before) < 1e-6, "an edit back")
	expect(s.move_to(same) == null and s.get_error()["name"] == "HF_ERROR_CONFLICT", "a surface of another origin: " + str(s.get_error()))
	s.edit([3, 4, 5], [100, 100, 0.5])
	expect(s.move_to(plain) == true and farthest(s.solve(), before) < 1e-6 and s.stiffness()[3] == 1, "back to the old surface: " + str(s.get_error()))

	# a patch, against a surface of the same triangles
	s = made_of(torus.positions, torus.triangles)
	var keep = HfSurface.new()
	keep.share_from(s)
	var distances = s.distance([0])
	s.direction_create(4)
	s.add_handles([[0, 1]])
	var middle = Vector3(4, 0.6, 0.4)
	expect(s.edit_patch([0], [middle], [0, 12, 288, 12, 13, 288, 13, 0, 288]) == null and s.get_error()["name"] == "HF_ERROR_UNSUPPORTED"
		and s.report().vertex_count == 288 and farthest(s.solve(), before) < 1e-6, "a pose with handles stays: " + str(s.get_error()))
	s.remove_handles([0])
	expect(s.edit_patch([0], [middle], [0, 12, 288, 12, 13, 288, 13, 0, 288]) == true, "edit_patch: " + str(s.get_error()))
	var positions = torus.positions + [4, 0.6, 0.4]
	var triangles = torus.triangles + [0, 12, 288, 12, 13, 288, 13, 0, 288]
	for _corner in 3:
		triangles.pop_front()
	var fresh = made_of(positions, triangles)
	expect(s.solve().size() == 289 and farthest(s.solve(), fresh.solve()) < 1e-6, "a field after a patch")
	expect(farthest(s.distance([0]), fresh.distance([0])) < 1e-5 and distances.size() == 288, "distances after a patch")
	expect(s.direction_solve() == null and s.get_error()["name"] == "HF_ERROR_INVALID_OBJECT", "directions of the old triangles are gone")
	for one in [s, fresh]:
		one.add_handles([[0, 1], [140, 141]])
		one.set_transform(1, null, Vector3(0, 0, 1))
	expect(farthest(s.deform({"iteration_count": 100}), fresh.deform({"iteration_count": 100})) < 1e-3, "a pose after a patch")

	# a cut, and corners that the host takes over; then back
	s = made_of(torus.positions, torus.triangles)
	var corners = s.edit_cut([0, 1, 1, 2])
	expect(corners != null and corners.size() > 0 and corners.size() == s.cuts().size() and s.report().boundary_edge_count == 4, "edit_cut")
	triangles = torus.triangles.duplicate()
	for row in corners:
		expect(triangles[3 * row.triangle + row.corner] == row.copied and row.copied == 1 and row.vertex == 288, "a corner of a cut")
		triangles[3 * row.triangle + row.corner] = row.vertex
	var at = torus.positions
	fresh = made_of(at + [at[3], at[4], at[5]], triangles)
	expect(farthest(s.solve(), fresh.solve()) < 1e-6, "a field after a cut")
	expect(s.edit_cut([4, 40]) == null and s.get_error()["name"] == "HF_ERROR_NOT_FOUND", "an edge that is not there")
	s = made_of(torus.positions, torus.triangles)
	expect(s.edit_cut([3, 4, 4, 5]).size() > 0 and s.add_site(288, 5) != null, "a site at the copy")
	var refused = HfSurface.new()
	refused.create(torus.positions, torus.triangles, {"weld": 1})
	expect(s.move_to(refused) == null and s.report().vertex_count == 289, "a refused move changes nothing")
	expect(refused.move_to(s) == null and refused.get_error()["name"] == "HF_ERROR_CONFLICT" and refused.report().vertex_count == 288,
		"a surface with nothing on it is refused too")
	# a state with a site at a vertex that is gone stays recorded
	s = made_of(torus.positions, torus.triangles)
	var uncut = HfSurface.new()
	uncut.share_from(s)
	s.edit_cut([3, 4, 4, 5])
	var site = s.add_site(288, 5)
	s.record()
	s.remove_sites([site])
	expect(s.move_to(uncut) == true, "sites at old vertices go back")
	var now = s.solve()
	expect(s.undo() == null and s.get_error()["name"] == "HF_ERROR_CONFLICT" and farthest(s.solve(), now) == 0, "a refused undo")
	s.edit_cut([3, 4, 4, 5])
	expect(s.redo() == null and s.get_error()["name"] == "HF_ERROR_EMPTY", "nothing was undone")
	for wrong in [[[0], [1, 2]], [null, [1]], [null, null, [1, 2]], [null, null, null, [7]], [null, null], ["text", self]]:
		expect(s.callv("edit", wrong) == null and s.get_error().has("message"), "edit" + str(wrong))
	for wrong in [[], [[9999]], [null, [1, 2]], [null, null, [1, 2]], [null, null, null]]:
		expect(s.callv("edit_patch", wrong) == null and s.get_error().has("message"), "edit_patch" + str(wrong))
	expect(s.edit_cut([1]) == null and s.edit_cut(null) == null and s.move_to(null) == null and s.move_to(self) == null, "wrong edits")
	s.dispose()
	expect(s.edit([0], [2]) == null and s.edit_cut([0, 1]) == null and s.move_to(keep) == null and s.links() == null, "stale edits")
	print("edits: in place, with what moves along")

# A sword is dropped where it is and taken up again while its hand is dragged.
func attached():
	var pair = meshes["pair"]
	var deformer = Deformer.new()
	var made = ArrayMesh.new()
	var given = []
	given.resize(Mesh.ARRAY_MAX)
	var points = []
	for i in range(0, pair.positions.size(), 3):
		points.append(Vector3(pair.positions[i], pair.positions[i + 1], pair.positions[i + 2]))
	given[Mesh.ARRAY_VERTEX] = PackedVector3Array(points)
	given[Mesh.ARRAY_INDEX] = PackedInt32Array(pair.triangles)
	made.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, given)
	deformer.mesh = made
	get_root().add_child(deformer)
	expect(deformer.bind({"weld": 1}), "bind")
	deformer.add_handle(Vector3(0, 0, 0), 0.3)
	var hand = deformer.add_handle(Vector3(1, 0.5, 0), 0.3)
	var grip = 35
	expect(deformer.attach(grip, 0.001) == null and deformer.surface.links().size() == 0, "nothing in reach")
	expect(deformer.attach(grip, 0.3) == 3 and deformer.surface.report().component_count == 1, "three links join two pieces")
	for row in deformer.surface.links():
		expect(row.length < 0.02, "the shortest ways: %s" % row.length)
	hand.transform.origin += Vector3(0, 0, 0.5)
	var held = deformer.update()
	for i in 30:
		held = deformer.update()
	expect(held[grip].distance_to(held[14]) < 0.1 and held[grip].z > 0.3, "the sword follows the hand: %s" % held[grip])
	var dropped = deformer.detach(grip)
	expect(dropped != null and deformer.surface.report().component_count == 2 and deformer.surface.links().size() == 0, "two components again")
	hand.transform.origin += Vector3(0, 0, 0.5)
	var loose = deformer.update()
	for i in 30:
		loose = deformer.update()
	expect(loose[grip].distance_to(held[grip]) < 0.02 and loose[14].z > held[14].z + 0.3, "the sword stays where it was dropped: %s, %s" % [loose[grip], held[grip]])
	dropped.transform.origin += Vector3(0, -0.25, 0)
	expect(abs(deformer.update()[49].y - loose[49].y + 0.25) < 1e-4, "and falls with its node")
	deformer.remove_handle(dropped)
	expect(deformer.attach(grip, 0.3) == 3, "taken up again")
	for i in 30:
		loose = deformer.update()
	expect(loose[grip].distance_to(loose[14]) < 0.1, "the sword is back in the hand")
	expect(deformer.surface.statistics()["factorisation_count"] == 0, "nothing is factorised")
	deformer.free()
	print("attach: a sword is dropped and taken up")

# Memory comes back: what 150 surfaces with factors and poses would hold is far more than what the process grows by.
func resident():
	var line = Host.first_line("/proc/self/statm")
	return int(line.split(" ")[1]) * 4096 if line != "" else 0

func memory():
	var torus = meshes["torus"]
	var before = 0
	for round_ in 180:
		if round_ == 30:
			before = resident()
		var s = HfSurface.new()
		s.create(torus.positions, torus.triangles)
		s.add_handles([[0, 1], [140, 141]])
		s.deform()
	var grown = resident() - before
	expect(before > 1000000 or Host.first_line("/proc/self/statm") == "", "cannot read what the process holds")
	print("memory after 150 more surfaces: ", grown / 1e6, " MB")
	expect(grown < 16e6, "memory does not come back")
	# and what 3000 arrays in and out would hold is more than 60 MB
	var surface = HfSurface.new()
	surface.create(torus.positions, torus.triangles)
	surface.add_handles([[0, 1], [140, 141]])
	for round_ in 3030:
		if round_ == 30:
			before = resident()
		surface.cast_ray(Vector3(0, 0, 9), Vector3(0, 0, -1), torus.positions.duplicate())
		surface.deform()
	grown = resident() - before
	print("memory after 3000 more calls: ", grown / 1e6, " MB")
	expect(grown < 8e6, "memory of arrays does not come back")

func expect(condition, message):
	if not condition:
		failed += 1
		print("FAILED ", message)

# A variable can hold what is no more. Other objects may have taken the place.
func freed():
	var node = Node3D.new()
	node.free()
	return node

# Objects of every kind, freed in any order; a transfer keeps what it needs.
func lifetime():
	var draw = RandomNumberGenerator.new()
	draw.seed = 7
	var bar = meshes["bar"]
	var calls = 0
	for _round in 120:
		var a = HfSurface.new()
		a.create(bar.positions, bar.triangles)
		var b = HfSurface.new()
		if draw.randf() < 0.5:
			b.clone_from(a)
		else:
			b.share_from(a)
		a.add_handles([[0, 1, 2], [280, 281]])
		expect(a.set_following([1], 0.5) == true and a.set_following([1], 2) == null and a.set_following([7], 0.5) == null, "set_following")
		expect(a.set_matrices([1], [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0.5, 0, 1]) == true and a.deform() != null, "set_matrices")
		expect(abs(a.handle_info(1).translation_y - 0.5) < 1e-9 and a.pose_statistics()["cluster_count"] > 0, "a handle by its matrix")
		expect(a.set_matrices([1], [1, 0]) == null and a.get_error()["message"].find("matrices must hold 16 numbers, not 2") >= 0, "a short matrix")
		expect(a.transfer_sinking() == null and a.get_error()["name"] == "HF_ERROR_INVALID_OBJECT", "no transfer sinks")
		expect(a.transfer_to(b, [[0, 1], [280]], [[0, 1], [280]], [1 + 32, 1]) == true, "transfer_to: " + str(a.get_error()))
		var sinking = a.transfer_sinking()
		expect(sinking.size() * 3 == bar.positions.size() and sinking[0] == 1 and sinking[280] == 0, "the first end may sink")
		expect(a.transfer_set_dials(1.5, 0.25) == true and a.transfer_dials()["stride"] == 1.5 and a.transfer_dials()["arm_space"] == 0, "transfer_set_dials")
		expect(a.transfer_set_dials(1, 0, 0, 0, 0, 1) == true and a.transfer_dials()["long_follow"] == 1, "the dial of long parts")
		expect(a.transfer_set_dials(1.5, 0.25) == true, "dials again")
		expect(a.transfer_set_dials(9) == null and a.transfer_dials()["hip_height_share"] == 0.25, "a refused dial")
		expect(a.transfer_set_dials() == true and a.transfer_dials()["hip_height_share"] == 0, "neutral dials")
		var pair = [a, b]
		if draw.randf() < 0.5:
			pair.reverse()
		pair[0].dispose()
		pair[0].dispose()
		expect(pair[0].solve() == null and pair[0].get_error()["name"] == "HF_ERROR_INVALID_OBJECT", "stale solve")
		expect(pair[0].deform() == null and pair[0].get_error()["index"] == -1, "stale deform")
		calls += 2
		if pair[0] == b:
			expect(a.transfer_apply(bar.positions).size() * 3 == bar.positions.size(), "transfer after its target has gone")
		a = null
		b = null
	for wrong in [[null, null], ["text", "text"], [[1, 2], [0]], [{}, {}], [3, 4],
		[self, self], [freed(), freed()], [[Vector3(), "x", Vector3()], [0, 1, 2]], [["x", 0, 0, 1, 0, 0, 0, 1, 0], [0, 1, 2]], [[NAN, 0, 0], [0, 0, 0]]]:
		var s = HfSurface.new()
		expect(s.create(wrong[0], wrong[1]) == null and s.get_error().has("message"), "create(" + str(wrong) + ")")
		expect(s.clone_from(wrong[0]) == null and s.share_from(wrong[0]) == null and s.transfer_to(wrong[0], [[0]], [[0]]) == null, "clone_from, transfer_to")
		calls += 3
	print("lifetime: ", calls, " wrong calls answered")

func imported():
	var scene = load("res://model.glb") if ResourceLoader.exists("res://model.glb") else null
	if scene == null:
		print("no model.glb in the project: the imported mesh is left out")
		return
	var root_node = scene.instantiate()
	var deformer = Deformer.new()
	deformer.mesh = Deformer.mesh_in(root_node)
	get_root().add_child(deformer)
	expect(deformer.bind(), "bind")
	var rest = deformer.arrays[Mesh.ARRAY_VERTEX]
	var box = AABB(rest[0], Vector3())
	var first = 0
	var last = 0
	for i in rest.size():
		box = box.expand(rest[i])
		if rest[i].z < rest[first].z:
			first = i
		if rest[i].z > rest[last].z:
			last = i
	var size = box.size.length()
	var fixed = deformer.add_handle(rest[first], 0.12 * size)
	var moved = deformer.add_handle(rest[last], 0.05 * size)
	expect(fixed != null and moved != null, "handles")
	moved.transform.origin += Vector3(0, 0.2 * size, 0)
	var posed = deformer.update()
	expect(posed.size() == rest.size(), "positions")
	var number_of = deformer.handles[moved].number
	var stands = deformer.surface.handle_info(number_of)
	expect(stands.free_rotation == 1 and deformer.surface.handle_info(deformer.handles[fixed].number).free_rotation == 0,
		"a move frees the rotation")
	expect(abs(stands.translation_y - 0.2 * size) < 1e-6 * size and abs(posed[last].y - rest[last].y - 0.2 * size) < 0.1 * size,
		"the moved handle lands")
	expect(posed[first].distance_to(rest[first]) < 1e-4 * size, "the other stays")
	var back = deformer.mesh.surface_get_arrays(0)[Mesh.ARRAY_VERTEX]
	expect(back[last].distance_to(posed[last]) < 1e-4 * size, "read back from Godot's mesh")
	var third = deformer.add_handle(box.position + 0.5 * box.size, 0.1 * size)
	expect(third != null and deformer.surface.statistics()["factorisation_count"] == 0,
		"a handle in mid-pose, no factorisation after the surface's")
	var hit = deformer.surface.cast_ray(posed[last] + Vector3(0, 0, size), Vector3(0, 0, -1), posed)
	expect(hit != null and not hit.is_empty() and abs(hit.z - posed[last].z) < 0.1 * size, "a ray hits the posed mesh")
	deformer.remove_handle(third)
	for i in 40:
		posed = deformer.update()
	third = deformer.add_handle(box.position + 0.5 * box.size, 0.1 * size, 0, true)
	var went = third.transform.origin.distance_to(deformer.handles[third].rest.origin)
	var still = deformer.update()
	var far = 0.0
	for i in rest.size():
		far = max(far, still[i].distance_to(posed[i]))
	expect(went > 0.01 * size and far < 0.1 * went, "a handle in place, %f off rest, moves the mesh by %f" % [went, far])
	deformer.remove_handle(third)
	for i in 40:
		posed = deformer.update()
	# a node that is turned gives the rotation, from where the handle stands
	var before = deformer.rotation_of(deformer.surface.handle_info(number_of))
	moved.rotate_x(0.01)
	for i in 40:
		still = deformer.update()
	var after = deformer.rotation_of(deformer.surface.handle_info(number_of))
	expect(abs(before.w) < 0.999 and deformer.surface.handle_info(number_of).free_rotation == 0 and deformer.handles[moved].given,
		"a turn gives the rotation")
	expect(abs(abs((after * before.inverse()).w) - cos(0.005)) < 1e-6, "the rotation goes on from where the handle stood")
	far = 0.0
	for i in rest.size():
		far = max(far, still[i].distance_to(posed[i]))
	expect(far < 0.01 * size, "a turn of 0.01 moves the mesh by %f of its size" % (far / size))
	deformer.free_rotation(moved)
	for i in 40:
		deformer.update()
	after = deformer.rotation_of(deformer.surface.handle_info(number_of))
	expect(deformer.surface.handle_info(number_of).free_rotation == 1, "a rotation is freed again")
	following(deformer, moved, size)
	print("imported glb: ", rest.size(), " vertices posed")
	root_node.free()
	deformer.free()

# A tip that is dragged hardly moves what it does not pull: the middle of the body.
func following(deformer, moved, size):
	var rest = deformer.arrays[Mesh.ARRAY_VERTEX]
	var sums = []
	var share = 0.25
	for follows in [1.0, share, 1.0]:
		deformer.set_following(moved, follows)
		var posed = []
		for i in 60:
			posed = deformer.update()
		var sum = 0.0
		for i in rest.size():
			sum += posed[i].distance_to(rest[i])
		sums.append(sum / rest.size() / size)
	expect(sums[1] < 0.7 * sums[0] and abs(sums[2] - sums[0]) < 1e-3, "how much follows: the body goes %s of its size" % [sums])
	expect(deformer.handles[moved].following == 1.0 and deformer.surface.handle_info(deformer.handles[moved].number).following == 1.0,
		"the dial is kept")
	deformer.keep_lengths(moved)
	expect(deformer.surface.handle_info(deformer.handles[moved].number).limb_refine == 8, "the limb keeps its lengths")
	expect(deformer.surface.set_following([deformer.handles[moved].number], 2) == null, "a wrong dial is refused")
	for row in deformer.surface.propose_handles():
		var added = deformer.add_proposed(row)
		if added != null:
			expect(deformer.handles[added].following == (1.0 if row.pinned else share), "a tip is proposed with a quarter")

# A body of bones whose frames are turned by `roll` about x, which moves no bone.
func skeleton(size, roll):
	var made = Skeleton3D.new()
	var turn = Basis(Vector3(1, 0, 0), roll)
	for bone in BONES:
		made.add_bone(bone[0])
		var index = made.get_bone_count() - 1
		made.set_bone_parent(index, bone[1])
		var place = bone[2] * size
		var rest = Transform3D(turn, place) if bone[1] < 0 else Transform3D(Basis(), turn.inverse() * place)
		made.set_bone_rest(index, rest)
		put(made, index, rest)
	return made

func put(skeleton, bone, transform):
	var place = transform.origin
	var turn = transform.basis.get_rotation_quaternion()
	var size = Vector3(1, 1, 1)
	skeleton.set_bone_pose_position(bone, place)
	skeleton.set_bone_pose_rotation(bone, turn)
	skeleton.set_bone_pose_scale(bone, size)

# Where a bone is in the skeleton, with what its parents do.
func place_of(skeleton, bone):
	var place = Transform3D()
	while bone >= 0:
		place = skeleton.get_bone_pose(bone) * place
		bone = skeleton.get_bone_parent(bone)
	return place

const BONES = [["hips", -1, Vector3(0, 1, 0)], ["spine", 0, Vector3(0, 0.3, 0)], ["head", 1, Vector3(0, 0.4, 0)],
	["left_thigh", 0, Vector3(0.1, -0.05, 0)], ["left_shin", 3, Vector3(0, -0.45, 0.02)], ["left_foot", 4, Vector3(0, -0.42, -0.02)],
	["right_thigh", 0, Vector3(-0.1, -0.05, 0)], ["right_shin", 6, Vector3(0, -0.45, 0.02)], ["right_foot", 7, Vector3(0, -0.42, -0.02)]]

# Where a bone of BONES stands at rest.
func stands(bone):
	return BONES[bone][2] + (stands(BONES[bone][1]) if BONES[bone][1] >= 0 else Vector3())

# A mesh of boxes, one for each bone of BONES, in another size. number: of a bone in its skin.
func boxes(size, number):
	var at = PackedVector3Array()
	var corners = PackedInt32Array()
	var bones = PackedInt32Array()
	var weights = PackedFloat32Array()
	for bone in BONES.size():
		var above = BONES[bone][1]
		var box = AABB(stands(bone), Vector3()).expand(stands(above) if above >= 0 else stands(bone) + Vector3(0, 0.1, 0))
		box = box.grow(0.15 if bone == 2 else 0.06)
		for corner in 8:
			at.append(size * (box.position + box.size * Vector3(corner & 1, corner >> 1 & 1, corner >> 2 & 1)))
			for k in 4:
				bones.append(number[bone] if k == 0 else 0)
				weights.append(1.0 if k == 0 else 0.0)
		for corner in [0, 3, 2, 0, 1, 3, 4, 7, 5, 4, 6, 7, 0, 5, 1, 0, 4, 5, 2, 7, 6, 2, 3, 7, 0, 6, 4, 0, 2, 6, 1, 7, 3, 1, 5, 7]:
			corners.append(8 * bone + corner)
	var arrays = []
	arrays.resize(Mesh.ARRAY_MAX)
	arrays[Mesh.ARRAY_VERTEX] = at
	arrays[Mesh.ARRAY_INDEX] = corners
	arrays[Mesh.ARRAY_BONES] = bones
	arrays[Mesh.ARRAY_WEIGHTS] = weights
	var mesh = ArrayMesh.new()
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays)
	return mesh

# A skeleton names the proposals, and a head is whole; also where a skin numbers the bones and has another unit.
func proposals():
	var body = skeleton(1, 0.4)
	var skin = Skin.new()
	var numbers = [[], []]
	for bone in BONES.size():
		numbers[0].append(bone)
		numbers[1].append(BONES.size() - 1 - bone)
	for bind in BONES.size():
		var bone = BONES.size() - 1 - bind
		var rest = Transform3D(Basis(Vector3(1, 0, 0), 0.4), stands(bone))
		skin.add_bind(bone, rest.affine_inverse() * Transform3D(Basis().scaled(Vector3(0.5, 0.5, 0.5)), Vector3()))
	for one in 2:
		var deformer = Deformer.new()
		deformer.mesh = boxes(one + 1, numbers[one])
		get_root().add_child(deformer)
		expect(deformer.bind({ "link_pieces": 1 }), "boxes")
		var rows = deformer.propose(body, skin if one == 1 else null)
		expect(rows != null and rows.size() > 2, "proposals by a skeleton: %s" % str(deformer.surface.get_error()))
		var feet = []
		for row in rows:
			if row.pinned and row.role == 10:
				feet.append(row.bone)
			if row.role == 3:
				expect(row.bone == "head" and Array(row.region) == range(16, 24) and not row.pinned, "a head is whole: %s" % [row])
				var head = deformer.add_proposed(row)
				expect(head != null and deformer.handles[head].following == 0.25, "the head is added")
				feet.append("head")
		feet.sort()
		expect(feet == ["head", "left_foot", "right_foot"], "feet hold, a head waits: %s" % [feet])
		expect(deformer.surface.propose_handles("a", [0], [0, 0]) == null, "wrong lists are refused")
		expect(not deformer.propose()[0].has("bone"), "no skeleton, no name")
		deformer.free()
	body.free()
	print("proposals: a skeleton names them")

# A frame of hf_retarget.gd is what the library makes of the plain arrays.
func retargeted():
	var man = skeleton(1, 0)
	var robot = skeleton(2, 1.2)
	var player = Player.new()
	expect(player.bind(man, robot), "skeletons are paired")
	var plain = HfSurface.new()
	var names = []
	var parents = []
	var rests = [[], []]
	for bone in BONES.size():
		names.append(BONES[bone][0])
		parents.append(BONES[bone][1])
		for one in 2:
			var size = one + 1
			var place = BONES[bone][2] * size
			var half = 0.6 * one
			if bone == 0:
				rests[one] += [place.x, place.y, place.z, sin(half), 0, 0, cos(half), 1, 1, 1]
			else:
				place = Basis(Vector3(1, 0, 0), -2 * half) * place
				rests[one] += [place.x, place.y, place.z, 0, 0, 0, 1, 1, 1, 1]
	var text = names[0]
	for i in range(1, names.size()):
		text += "\n" + names[i]
	expect(plain.retarget_create(text, parents, rests[0], text, parents, rests[1]) == true, str(plain.get_error()))
	expect(plain.retarget_info().matched_joint_count == 9 and abs(plain.retarget_info().scale - 2) < 0.01, "every bone has its partner")
	var most = 0.0
	var pose = rests[0].duplicate()
	for frame in 20:
		pose[2] = 0.05 * frame
		pose[33] = sin(-0.025 * frame)
		pose[36] = cos(0.025 * frame)
		put(man, 0, Transform3D(Basis(), Vector3(0, 1, pose[2])))
		put(man, 3, Transform3D(Basis(Vector3(1, 0, 0), -0.05 * frame), BONES[3][2]))
		player.play(0.04)
		var wanted = plain.retarget_solve(pose, 0.04)
		for bone in BONES.size():
			var place = Vector3(wanted[10 * bone], wanted[10 * bone + 1], wanted[10 * bone + 2])
			var turn = Quaternion(wanted[10 * bone + 3], wanted[10 * bone + 4], wanted[10 * bone + 5], wanted[10 * bone + 6])
			var stands = player.pose_of(robot, bone)
			most = max(most, max(stands.origin.distance_to(place), 1 - abs(stands.basis.get_rotation_quaternion().dot(turn))))
	expect(most < 1e-5, "a frame differs from the plain arrays by %s" % most)
	var knee = place_of(robot, 4).origin - place_of(robot, 3).origin
	var knee_of_man = place_of(man, 4).origin - place_of(man, 3).origin
	expect(knee.distance_to(2 * knee_of_man) < 0.05 and place_of(robot, 0).origin.z > 1.8, "the robot walks as the man does")
	player.reset()
	put(man, 3, Transform3D(Basis(), Vector3(NAN, 0, 0)))
	var stood = place_of(robot, 4)
	player.play(0.04)
	expect(place_of(robot, 4) == stood, "a refused frame changes nothing")
	var rock = Skeleton3D.new()
	rock.add_bone("rock")
	expect(not player.bind(rock, robot) and player.from == man, "a skeleton without a partner is refused, and the old one stays")
	expect(plain.retarget_create("a", [0], [0, 0], "a", [-1], rests[1]) == null and plain.retarget_solve([1], 0) == null, "wrong lists are refused")
	for made in [man, robot, rock, player]:
		made.free()
	print("retarget: ", BONES.size(), " bones of one skeleton follow another")

func _initialize():
	for name in ["strip", "torus", "bar", "long_bar", "small", "lonely", "pair"]:
		meshes[name] = read(OS.get_environment("HF_GOLDEN") + "/meshes/" + name + ".json")
	golden(OS.get_environment("HF_SCENES"))
	golden(OS.get_environment("HF_GOLDEN") + "/bad_input.json")
	print(done, " steps run, ", left_out, " left out, ", wrong, " wrong calls answered")
	expect(done > 500 and wrong >= 275, "too few steps")
	unknown_steps()
	edited()
	attached()
	lifetime()
	memory()
	retargeted()
	proposals()
	imported()
	quit(1 if failed > 0 else 0)
