"""Changed copies of .glb models: each change of CHANGES gives a Copy, whose results must be those of the model."""
import copy
import json
import random
import struct

FORMATS = {5120: "b", 5121: "B", 5122: "h", 5123: "H", 5125: "I", 5126: "f"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
ARRAY_TARGET, INDEX_TARGET = 34962, 34963


class Model:
    """The JSON and the bytes of a .glb file."""

    def __init__(self, file):
        data = open(file, "rb").read()
        size = struct.unpack_from("<I", data, 12)[0]
        self.json = json.loads(data[20:20 + size])
        self.bytes = bytearray(data[28 + size:28 + size + struct.unpack_from("<I", data, 20 + size)[0]])

    def clone(self):
        return copy.deepcopy(self)

    def rows(self, number):
        """The rows of an accessor, as tuples of stored numbers."""
        a = self.json["accessors"][number]
        view = self.json["bufferViews"][a["bufferView"]]
        form = "<%d%s" % (WIDTHS[a["type"]], FORMATS[a["componentType"]])
        stride = view.get("byteStride", struct.calcsize(form))
        start = view.get("byteOffset", 0) + a.get("byteOffset", 0)
        return [struct.unpack_from(form, self.bytes, start + i * stride) for i in range(a["count"])]

    def add(self, like, rows, component=None, target=None, gap=0):
        """A new accessor with the type of another, and other rows. gap: bytes between rows."""
        a = dict(self.json["accessors"][like])
        a["componentType"] = component or a["componentType"]
        form = "<%d%s" % (WIDTHS[a["type"]], FORMATS[a["componentType"]])
        self.bytes += b"\0" * (-len(self.bytes) % 4)
        view = {"buffer": 0, "byteOffset": len(self.bytes)}
        size = struct.calcsize(form)
        padding = -size % 4 if target == ARRAY_TARGET else 0
        for row in rows:
            self.bytes += struct.pack(form, *row) + b"\0" * (padding + gap)
        view["byteLength"] = len(self.bytes) - view["byteOffset"]
        if padding + gap:
            view["byteStride"] = size + padding + gap
        if target:
            view["target"] = target
        self.json["bufferViews"].append(view)
        a.update(bufferView=len(self.json["bufferViews"]) - 1, count=len(rows))
        a.pop("byteOffset", None)
        if "min" in a:
            a["min"], a["max"] = [min(c) for c in zip(*rows)], [max(c) for c in zip(*rows)]
        self.json["accessors"].append(a)
        return len(self.json["accessors"]) - 1

    def corners(self, primitive):
        """Its indices; a primitive without them uses its vertices in order."""
        if "indices" in primitive:
            return [r[0] for r in self.rows(primitive["indices"])]
        return list(range(self.json["accessors"][primitive["attributes"]["POSITION"]]["count"]))

    def add_indices(self, corners, component):
        self.json["accessors"].append({"componentType": component, "type": "SCALAR"})
        number = self.add(len(self.json["accessors"]) - 1, corners, target=INDEX_TARGET)
        del self.json["accessors"][number - 1]
        return number - 1

    def primitives(self):
        """(primitive, its first vertex among those of all) in the order of hf."""
        out, first = [], 0
        for node in self.mesh_nodes():
            for primitive in self.json["meshes"][self.json["nodes"][node]["mesh"]]["primitives"]:
                out.append((primitive, first))
                first += self.json["accessors"][primitive["attributes"]["POSITION"]]["count"]
        return out

    def mesh_nodes(self):
        """Nodes with a mesh that the scene reaches, by their numbers: so hf takes them."""
        reached, waiting = set(), list(self.json["scenes"][self.json.get("scene", 0)]["nodes"])
        while waiting:
            node = waiting.pop()
            reached.add(node)
            waiting += self.json["nodes"][node].get("children", [])
        return [n for n in sorted(reached) if "mesh" in self.json["nodes"][n]]

    def write(self, file):
        self.json["buffers"] = [{"byteLength": len(self.bytes)}]
        text = json.dumps(self.json).encode()
        text += b" " * (-len(text) % 4)
        data = bytes(self.bytes) + b"\0" * (-len(self.bytes) % 4)
        with open(file, "wb") as out:
            out.write(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(data)))
            out.write(struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data)


class Copy:
    """A changed model; where vertex v of the model is; and how its frame lies: p goes to scale p + shift."""

    def __init__(self, model):
        self.model = model.clone()
        for i, node in enumerate(self.model.json["nodes"]):
            node.setdefault("name", "node %d" % i)
        self.count = sum(self.model.json["accessors"][p["attributes"]["POSITION"]]["count"]
                         for p, _ in self.model.primitives())
        self.vertex = list(range(self.count))
        self.scale, self.shift = 1.0, (0.0, 0.0, 0.0)
        self.joint = {}  # new names of nodes to those of the model

    def edit_primitives(self, edit):
        """edit(primitive rows by attribute, triangles) gives both anew, and where each old vertex is."""
        first = 0
        for primitive, old_first in self.model.primitives():
            lists = [("", primitive["attributes"])] + [(str(i), t) for i, t in enumerate(primitive.get("targets", []))]
            rows = {key + name: self.model.rows(a) for key, accessors in lists for name, a in accessors.items()}
            count = len(rows["POSITION"])
            corners = self.model.corners(primitive)
            triangles = [tuple(corners[i:i + 3]) for i in range(0, len(corners), 3)]
            rows, triangles, place = edit(rows, triangles)
            for key, accessors in lists:
                for name, a in accessors.items():
                    accessors[name] = self.model.add(a, rows[key + name], target=ARRAY_TARGET)
            corners = [(c,) for t in triangles for c in t]
            component = 5125 if len(rows["POSITION"]) > 65535 else 5123
            primitive["indices"] = self.model.add_indices(corners, component)
            for v in range(count):
                self.vertex[old_first + v] = first + place[v]
            first += len(rows["POSITION"])
        return self


def isolated(offset):
    """A vertex in no triangle at the end of every primitive, `offset` of the last vertex away."""
    def change(model):
        def edit(rows, triangles):
            count = len(rows["POSITION"])
            for name in rows:
                rows[name].append(rows[name][-1])
            low = [min(c) for c in zip(*rows["POSITION"])]
            size = max(max(c) - l for c, l in zip(zip(*rows["POSITION"]), low))
            rows["POSITION"][-1] = tuple(l + size * o for l, o in zip(low, offset))
            return rows, triangles, range(count)
        return Copy(model).edit_primitives(edit)
    return change


def doubled_faces(model):
    def edit(rows, triangles):
        return rows, triangles + [(b, c, a) for a, b, c in triangles[::40]], range(len(rows["POSITION"]))
    return Copy(model).edit_primitives(edit)


def vertex_order(model):
    def edit(rows, triangles):
        order = list(range(len(rows["POSITION"])))
        random.Random(5).shuffle(order)
        place = {old: new for new, old in enumerate(order)}
        rows = {name: [values[old] for old in order] for name, values in rows.items()}
        return rows, [tuple(place[v] for v in t) for t in triangles], place
    return Copy(model).edit_primitives(edit)


def face_order(model):
    def edit(rows, triangles):
        generator = random.Random(6)
        generator.shuffle(triangles)
        return rows, [t[k:] + t[:k] for t in triangles for k in [generator.randrange(3)]], range(len(rows["POSITION"]))
    return Copy(model).edit_primitives(edit)


def split_corners(model):
    """Every triangle has vertices of its own, behind those of the model."""
    def edit(rows, triangles):
        count = len(rows["POSITION"])
        used, out = set(), []
        for t in triangles:
            corners = []
            for v in t:
                if v in used:
                    for values in rows.values():
                        values.append(values[v])
                    corners.append(len(rows["POSITION"]) - 1)
                else:
                    used.add(v)
                    corners.append(v)
            out.append(tuple(corners))
        return rows, out, range(count)
    return Copy(model).edit_primitives(edit)


def long_indices(model):
    out = Copy(model)
    for primitive, _ in out.model.primitives():
        old = out.model.json["accessors"][primitive["indices"]]["componentType"] if "indices" in primitive else None
        corners = [(v,) for v in out.model.corners(primitive)]
        primitive["indices"] = out.model.add_indices(corners, 5125 if old != 5125 else 5123)
    return out


def strides(model):
    out = Copy(model)
    for primitive, _ in out.model.primitives():
        for name, a in primitive["attributes"].items():
            primitive["attributes"][name] = out.model.add(a, out.model.rows(a), target=ARRAY_TARGET, gap=8)
    return out


def node_order(model):
    out = Copy(model)
    j = out.model.json
    order = list(range(len(j["nodes"])))
    random.Random(7).shuffle(order)
    place = {old: new for new, old in enumerate(order)}
    count_of = {n: sum(j["accessors"][p["attributes"]["POSITION"]]["count"]
                       for p in j["meshes"][j["nodes"][n]["mesh"]]["primitives"]) for n in out.model.mesh_nodes()}
    first = {}
    for n in sorted(count_of, key=place.get):
        first[n] = sum(count_of[m] for m in first)
    out.vertex = [first[n] + k for n in sorted(count_of) for k in range(count_of[n])]
    j["nodes"] = [j["nodes"][old] for old in order]
    for node in j["nodes"]:
        if "children" in node:
            node["children"] = [place[c] for c in node["children"]]
    for scene in j["scenes"]:
        scene["nodes"] = [place[n] for n in scene["nodes"]]
    for skin in j.get("skins", []):
        skin["joints"] = [place[n] for n in skin["joints"]]
        if "skeleton" in skin:
            skin["skeleton"] = place[skin["skeleton"]]
    for animation in j.get("animations", []):
        for channel in animation["channels"]:
            if "node" in channel["target"]:
                channel["target"]["node"] = place[channel["target"]["node"]]
    return out


def joint_order(model):
    """The joints of each skin in another order; vertices and bind matrices follow."""
    out = Copy(model)
    j = out.model.json
    places = []
    for skin in j["skins"]:
        order = list(range(len(skin["joints"])))
        random.Random(8).shuffle(order)
        places.append({old: new for new, old in enumerate(order)})
        skin["joints"] = [skin["joints"][old] for old in order]
        matrices = out.model.rows(skin["inverseBindMatrices"])
        skin["inverseBindMatrices"] = out.model.add(skin["inverseBindMatrices"], [matrices[old] for old in order])
    done = set()
    for node in out.model.mesh_nodes():
        number = j["nodes"][node]["mesh"]
        if "skin" not in j["nodes"][node] or number in done:
            continue
        done.add(number)
        place = places[j["nodes"][node]["skin"]]
        for primitive in j["meshes"][number]["primitives"]:
            a = primitive["attributes"]
            rows = [tuple(place[x] for x in row) for row in out.model.rows(a["JOINTS_0"])]
            a["JOINTS_0"] = out.model.add(a["JOINTS_0"], rows, target=ARRAY_TARGET)
    return out


def renamed(rename):
    def change(model):
        out = Copy(model)
        for i, node in enumerate(out.model.json["nodes"]):
            old = node["name"]
            node["name"] = rename(i, old)
            out.joint[node["name"]] = old
        return out
    return change


def parent(scale, shift):
    """A node above all others, with a transform."""
    def change(model):
        out = Copy(model)
        j = out.model.json
        scene = j["scenes"][j.get("scene", 0)]
        j["nodes"].append({"name": "world", "children": scene["nodes"], "scale": [scale] * 3, "translation": list(shift)})
        scene["nodes"] = [len(j["nodes"]) - 1]
        out.scale, out.shift = scale, shift
        return out
    return change


CHANGES = [
    ("far vertex", "a vertex in no triangle, a thousand boxes away", isolated((1000, 1000, -1000))),
    ("near vertex", "a vertex in no triangle, at the side of the body", isolated((0.6, 0.5, 0.5))),
    ("foot vertex", "a vertex in no triangle, 0.3 boxes under the feet", isolated((0.3, -0.3, 0.3))),
    ("doubled faces", "every fortieth face once more", doubled_faces),
    ("vertex order", "vertices in random order", vertex_order),
    ("face order", "faces in random order, their corners turned", face_order),
    ("split corners", "every triangle has vertices of its own", split_corners),
    ("other indices", "32-bit indices for 16-bit ones, or the other way", long_indices),
    ("strides", "attributes with gaps between rows", strides),
    ("node order", "nodes in random order", node_order),
    ("joint order", "joints of the skin in random order", joint_order),
    ("prefixed joints", "every node has a prefix, as of a name space", renamed(lambda i, old: "rig:" + old)),
    ("renamed joints", "every node has another name", renamed(lambda i, old: "n%03d" % i)),
    ("parent node", "a node above all, without a transform", parent(1.0, (0.0, 0.0, 0.0))),
    ("moved parent", "a node above all, moved", parent(1.0, (3.0, 0.0, -5.0))),
    ("unit 0.01", "a node above all, of scale 0.01", parent(0.01, (0.0, 0.0, 0.0))),
    ("unit 100", "a node above all, of scale 100", parent(100.0, (0.0, 0.0, 0.0))),
]
