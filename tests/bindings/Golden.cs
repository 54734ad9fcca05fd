// The golden scenes (bindings/golden/README.md) through the C# classes: Golden.exe MESHES FILE...; then lifetime and
// memory.
using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using Hf;
using Hf.Native;
using Map = System.Collections.Generic.Dictionary<string, object>;
using Items = System.Collections.Generic.List<object>;

class Mismatch : Exception { public Mismatch(string message) : base(message) { } }

class Scene
{
    readonly Dictionary<string, Map> meshes;
    readonly Dictionary<string, HfObject> objects = new Dictionary<string, HfObject>();
    readonly Dictionary<string, object> kept = new Dictionary<string, object>();
    public Scene(Dictionary<string, Map> meshes) { this.meshes = meshes; }

    static void Expect(bool condition, string message) { if (!condition) throw new Mismatch(message); }

    static double Number(object value)
    {
        if (value is string) return (string)value == "nan" ? double.NaN : (string)value == "inf"
            ? double.PositiveInfinity : double.NegativeInfinity;
        return (double)value;
    }

    static IEnumerable<long> Bits(double[] array) { return array.Select(BitConverter.DoubleToInt64Bits); }

    static object Get(Map step, string key) { object value; return step.TryGetValue(key, out value) ? value : null; }

    double[] Doubles(Map step, string key)
    {
        object value = Get(step, key);
        if (value is string) return (double[])kept[(string)value];
        return value == null ? null : ((Items)value).Select(Number).ToArray();
    }

    Place[] PlacesOf(Map step)
    {
        double[] list = Doubles(step, "places");
        if (list == null) return null;
        return Enumerable.Range(0, list.Length / 6).Select(i => new Place(
            list.Skip(6 * i).Take(3).Select(x => (uint)x).ToArray(), list.Skip(6 * i + 3).Take(3).ToArray())).ToArray();
    }

    Place PlaceOf(Map step, string key)
    {
        double[] list = Doubles(step, key);
        if (list.Length == 1) return (uint)list[0];
        return new Place(list.Take(3).Select(x => (uint)x).ToArray(), list.Skip(3).ToArray());
    }
    static uint[] Numbers(object list)
    {
        return list == null ? null : ((Items)list).Select(x => (uint)(double)x).ToArray();
    }

    /// FaceCount -> face_count
    static string CName(string name)
    {
        return string.Concat(name.Select((letter, i) => char.IsUpper(letter) ? (i > 0 ? "_" : "") + char.ToLower(letter) : letter.ToString()));
    }

    /// The fields of a result that are single numbers.
    static Map Fields(object row)
    {
        return row.GetType().GetFields().Where(f => f.FieldType.IsPrimitive || f.FieldType.IsEnum)
            .ToDictionary(f => CName(f.Name), f => (object)Convert.ToDouble(f.GetValue(row)));
    }

    static uint[][] Lists(object lists) { return lists == null ? null : ((Items)lists).Select(Numbers).ToArray(); }
    // a bool of C# is no third value, so the test refuses it
    static bool Flag(Map step, string key)
    {
        double value = Get(step, key) == null ? 0 : (double)Get(step, key);
        if (value != 0 && value != 1) throw new HfException(key + " must be 0 or 1");
        return value == 1;
    }
    static uint Whole(Map step, string key)
    {
        object value = Get(step, key);
        return value == null ? 0 : (uint)(double)value;
    }


    /// Options by their C names; an unknown one fails as the other languages fail.
    static Dictionary<string, double> Options(Map step, params string[] allowed)
    {
        var found = allowed.ToDictionary(name => name, name => 0.0);
        foreach (var pair in (Map)Get(step, "options") ?? new Map())
        {
            if (!found.ContainsKey(pair.Key)) throw new HfException("no option " + pair.Key);
            found[pair.Key] = pair.Value is string
                ? Convert.ToDouble(typeof(Constants).GetField((string)pair.Value).GetRawConstantValue())
                : (double)pair.Value;
        }
        return found;
    }

    float[] Floats(Map step, string key)
    {
        double[] values = Doubles(step, key);
        return values == null ? null : values.Select(x => (float)x).ToArray();
    }

    static string[] Names(Map step)
    {
        object list = Get(step, "names");
        return list == null ? null : ((Items)list).Cast<string>().ToArray();
    }

    int[] Deforms(Map step)
    {
        double[] deforms = Doubles(step, "deforms");
        return deforms == null ? null : deforms.Select(x => (int)x).ToArray();
    }

    /// The weight of one joint at every vertex.
    static double[] Column(WeightsOut found, uint joint)
    {
        var column = new double[found.Origins.Length];
        for (int i = 0; i < found.Joints.Length; ++i)
            if (found.Joints[i] == joint) column[i / found.InfluenceCount] += found.Weights[i];
        return column;
    }

    static void Compare(double[] a, Map wanted)
    {
        double sum = 0, weighted = 0;
        double least = a.Length > 0 ? double.MaxValue : 0, most = a.Length > 0 ? double.MinValue : 0;
        for (int i = 0; i < a.Length; ++i)
        {
            Expect(!double.IsNaN(a[i]) && !double.IsInfinity(a[i]), "not finite");
            sum += a[i];
            weighted += a[i] * (i % 7 + 1);
            least = Math.Min(least, a[i]);
            most = Math.Max(most, a[i]);
        }
        double t = wanted.ContainsKey("tolerance") ? (double)wanted["tolerance"] : 0;
        Action<string, double, double> near = (key, found, room) =>
        {
            if (wanted.ContainsKey(key)) Expect(Math.Abs(found - (double)wanted[key]) <= room,
                key + " is " + found + ", not " + wanted[key]);
        };
        near("count", a.Length, 0);
        near("sum", sum, t * a.Length + 1e-9);
        near("weighted", weighted, 7 * t * a.Length + 1e-9);
        near("min", least, t);
        near("max", most, t);
        if (!wanted.ContainsKey("at")) return;
        uint[] places = Numbers(wanted["at"]);
        for (int k = 0; k < places.Length; ++k)
            Expect(Math.Abs(a[places[k]] - (double)((Items)wanted["values"])[k]) <= t, "value at " + places[k]);
    }

    object Run(Map step)
    {
        string what = (string)step["do"], name = (string)Get(step, "as");
        HfObject on = null;
        if (step.ContainsKey("on")) objects.TryGetValue((string)step["on"], out on);
        Surface surface = on as Surface;
        Solver solver = on as Solver;
        Pose pose = on as Pose;
        Transfer transfer = on as Transfer;
        uint[] sites = Numbers(Get(step, "sites")), vertices = Numbers(Get(step, "vertices"));
        switch (what)
        {
            case "surface":
                {
                    var o = Options(step, "weld", "weld_tolerance", "operator_kind", "field_kind", "ordering",
                        "thread_count", "vertex_limit", "triangle_limit", "memory_limit_mb", "link_pieces");
                    double[] positions = null;
                    uint[] triangles = null;
                    if (step["mesh"] == null) throw new HfException("no positions", Constants.HF_ERROR_NULL_POINTER);
                    {
                        Map mesh = meshes[(string)step["mesh"]];
                        positions = ((Items)mesh["positions"]).Select(Number).ToArray();
                        triangles = Numbers(mesh["triangles"]);
                    }
                    foreach (var pair in (Map)Get(step, "positions") ?? new Map())
                        positions[int.Parse(pair.Key)] = Number(pair.Value);
                    foreach (var pair in (Map)Get(step, "triangles") ?? new Map())
                        triangles[int.Parse(pair.Key)] = (uint)(double)pair.Value;
                    if (step.ContainsKey("no_triangles")) triangles = new uint[0];
                    byte[] factor = step.ContainsKey("factor") ? (byte[])((byte[])kept[(string)step["factor"]]).Clone()
                        : null;
                    if (step.ContainsKey("damage")) factor[Whole(step, "damage")] ^= 1;
                    var faces = (Map)Get(step, "faces");
                    Indices indices = faces != null ? null : Whole(step, "index_bits") == 16
                        ? (Indices)triangles.Select(v => (ushort)v).ToArray() : triangles;
                    uint[] tags = Numbers(Get(step, "tags"));
                    if (tags != null && o["link_pieces"] == 0) throw new HfException("tags are those of links");
                    objects[name] = new Surface(positions, indices, faces: faces == null ? null
                        : new FacesDesc { Starts = Numbers(faces["offsets"]), Corners = Numbers(faces["corners"]) }, weld: (Weld)o["weld"],
                        weldTolerance: o["weld_tolerance"], operatorKind: (Operator)o["operator_kind"],
                        fieldKind: (FieldKind)o["field_kind"], ordering: (Ordering)o["ordering"],
                        threadCount: (uint)o["thread_count"], vertexLimit: (uint)o["vertex_limit"],
                        triangleLimit: (uint)o["triangle_limit"], memoryLimitMb: (uint)o["memory_limit_mb"],
                        savedFactor: factor, links: o["link_pieces"] == 0 ? null
                        : new LinksDesc { Mode = LinkMode.Pieces, Tags = tags });
                    return null;
                }
            case "graph":
                {
                    var o = Options(step, "allow_negative", "field_kind", "ordering", "thread_count", "vertex_limit",
                        "edge_limit", "memory_limit_mb");
                    objects[name] = Surface.FromGraph(Numbers(Get(step, "edges")), Doubles(step, "weights"),
                        Doubles(step, "masses"), Whole(step, "vertex_count"), allowNegative: o["allow_negative"] == 1,
                        fieldKind: (FieldKind)o["field_kind"], ordering: (Ordering)o["ordering"],
                        threadCount: (uint)o["thread_count"], vertexLimit: (uint)o["vertex_limit"],
                        edgeLimit: (uint)o["edge_limit"], memoryLimitMb: (uint)o["memory_limit_mb"]);
                    return null;
                }
            case "solver":
                {
                    var o = Options(step, "field_kind", "channel_count", "site_limit");
                    objects[name] = new Solver(surface, (FieldKind)o["field_kind"], (uint)o["channel_count"],
                        (uint)o["site_limit"]);
                    return null;
                }
            case "clone": objects[name] = solver.Clone(); return null;
            case "edit_surface":
                {
                    double[] rows = Doubles(step, "links");
                    Link[] links = rows == null ? null : Enumerable.Range(0, rows.Length / 8).Select(i => new Link
                    {
                        Vertex = (uint)rows[8 * i],
                        Corners = rows.Skip(8 * i + 1).Take(3).Select(v => (uint)v).ToArray(),
                        Barycentrics = rows.Skip(8 * i + 4).Take(3).ToArray(),
                        Weight = rows[8 * i + 7],
                    }).ToArray();
                    var patch = new PatchDesc
                    {
                        RemovedTriangles = Numbers(Get(step, "removed_triangles")),
                        NewPositions = Doubles(step, "new_positions"),
                        NewTriangles = Numbers(Get(step, "new_triangles")),
                        CutEdges = Numbers(Get(step, "cut_edges")),
                    };
                    bool patches = patch.RemovedTriangles != null || patch.NewTriangles != null || patch.CutEdges != null;
                    objects[name] = surface.Edit(vertices, Doubles(step, "stiffness"), links,
                            Numbers(Get(step, "removed_links")), patches ? patch : null);
                    return null;
                }
            case "cut_surface":
                {
                    Cut cut = surface.TraceCut(places: PlacesOf(step));
                    var patch = new PatchDesc { RemovedTriangles = cut.RemovedTriangles, NewPositions = cut.NewPositions,
                        NewTriangles = cut.NewTriangles };
                    objects[name] = surface.Edit(patch: patch);
                    return Enumerable.Range(0, cut.SourceTriangles.Length).SelectMany(t => new double[] { cut.SourceTriangles[t] }
                        .Concat(cut.NewTriangles.Skip(3 * t).Take(3).Select(v => (double)v))
                        .Concat(cut.CornerBarycentrics.Skip(9 * t).Take(9))).ToArray();
                }
            case "cuts": return surface.Cuts().SelectMany(c => new double[] { c.Triangle, c.Corner, c.Vertex, c.Copied }).ToArray();
            case "move_to":
                {
                    var edited = (Surface)objects[(string)step["to"]];
                    if (pose != null) pose.MoveTo(edited);
                    else solver.MoveTo(edited);
                    return null;
                }
            case "dispose": on.Dispose(); return null;
            case "add_sites": return solver.AddSites(vertices, Doubles(step, "values"), PlacesOf(step),
                stiffness: Doubles(step, "stiffness"), radii: Doubles(step, "radii"));
            case "add_site": return new[] { step.ContainsKey("value")
                ? solver.AddSite(Whole(step, "vertex"), new[] { Number(step["value"]) }) : solver.AddSite(Whole(step, "vertex")) };
            case "remove_sites": solver.RemoveSites(sites); return null;
            case "move_sites": solver.MoveSites(sites, vertices); return null;
            case "set_values": solver.SetValues(sites, Doubles(step, "values")); return null;
            case "edit": return solver.EditSites(Numbers(Get(step, "remove")), Numbers(Get(step, "move")), Numbers(Get(step, "set")),
                Doubles(step, "set_values"), Numbers(Get(step, "move_to")), !step.ContainsKey("add") ? null : new SitesDesc {
                Vertices = Numbers(step["add"]), Values = Doubles(step, "add_values") });
            case "record": solver.Record(); return null;
            case "undo": solver.Undo(); return null;
            case "redo": solver.Redo(); return null;
            case "solve": return solver.SolveDouble();
            case "solve_f32": return solver.Solve().Select(x => (double)x).ToArray();
            case "preview": return solver.SolvePreviewDouble(Whole(step, "correction_count"));
            case "solve_at": return solver.SolveAt(vertices);
            case "report": return Fields(surface.Report);
            case "surface_statistics": return Fields(surface.Statistics);
            case "surface_info": return Fields(surface.Info);
            case "solver_info": return Fields(solver.Info);
            case "pose_info": return Fields(pose.Info);
            case "statistics": return Fields(solver.Statistics);
            case "components": return surface.Components().Select(c => (double)c).ToArray();
            case "cast_ray":
                {
                    double front = Get(step, "front_only") == null ? 0 : Number(step["front_only"]);
                    if (front != 0 && front != 1) throw new HfException("front_only is a bool in C#");
                    Hit hit = surface.CastRay(Doubles(step, "origin"), Doubles(step, "direction"),
                        Doubles(step, "positions"), frontOnly: front == 1);
                    if (hit == null) return new double[] { 0 };
                    return new double[] { 1, hit.Triangle, hit.Vertex }.Concat(hit.Place.Barycentrics).Concat(hit.Position)
                        .Concat(new[] { hit.Distance }).ToArray();
                }
            case "find_vertex":
                {
                    var nearest = surface.FindVertex(Doubles(step, "point"), Doubles(step, "positions"));
                    return new[] { nearest.Vertex, nearest.Distance };
                }
            case "certify":
                return Fields(solver.Certify(step.ContainsKey("tolerance") ? Number(step["tolerance"]) : 0));
            case "save": kept[name] = surface.Save((FieldKind)Whole(step, "field_kind")); return null;
            case "levels": return surface.SpaceLevels(Doubles(step, "field"), Whole(step, "count"),
                (string)step["spacing"] == "HF_LEVELS_AREA" ? Levels.Area : Levels.Value);
            case "isolines":
                {
                    Isolines lines = surface.TraceIsolines(Doubles(step, "field"), Doubles(step, "levels"));
                    if (step.ContainsKey("lines"))
                        {
                        int closed = lines.LineClosed.Sum();
                        bool right = lines.LineLevels.Length == Whole(step, "lines") && closed == Whole(step, "closed");
                        Expect(right, "lines");
                    }
                    return lines.Positions;
                }
            case "critical": return surface.FindCriticalPoints(Doubles(step, "field")).Select(p =>
                (double)p.Index).ToArray();
            case "propose": return surface.ProposeHandles().Select(p => (double)p.Vertex).OrderBy(x => x).ToArray();
            case "extremities": return surface.FindExtremities().Select(p => (double)p.Vertex).OrderBy(x => x).ToArray();
            case "geodesics":
                {
                    var o = Options(step, "method");
                    objects[name] = new Geodesics(surface, (DistanceMethod)o["method"]);
                    return null;
                }
            case "path": return ((Geodesics)on).FindPath(PlaceOf(step, "from"), PlaceOf(step, "to")).Positions;
            case "map": return ((Geodesics)on).Map(PlaceOf(step, "centre"), step.ContainsKey("radius") ? Number(step["radius"]) : 0).Map;
            case "distance": return ((Geodesics)on).SolveDouble(Numbers(Get(step, "sources")));
            case "direction": objects[name] = new Direction(surface, (uint)Options(step, "degree")["degree"]);
                return null;
            case "add_vectors": return ((Direction)on).AddSites(vertices, Doubles(step, "vectors"));
            case "rotate": ((Direction)on).RotateSites(sites, Doubles(step, "angles")); return null;
            case "remove_vectors": ((Direction)on).RemoveSites(sites); return null;
            case "move_vectors": ((Direction)on).MoveSites(sites, vertices); return null;
            case "set_vectors": ((Direction)on).SetVectors(sites, Doubles(step, "vectors")); return null;
            case "record_vectors": ((Direction)on).Record(); return null;
            case "undo_vectors": ((Direction)on).Undo(); return null; case "redo_vectors": ((Direction)on).Redo(); return null;
            case "clone_vectors": objects[name] = ((Direction)on).Clone(); return null;
            case "vectors": return ((Direction)on).Sites().Vectors;
            case "quads":
            case "update_quads":
                {
                    var o = Options(step, "relax_count", "face_count", "crease_angle");
                    Func<string, uint[]> whole = key => Numbers(Get(step, key));
                    Func<string, double[]> real = key => Doubles(step, key);
                    double edge = step.ContainsKey("edge_length") ? Number(step["edge_length"]) : 0;
                    if (what == "quads")
                    {
                        objects[name] = new Quads(surface, whole("crease_edges"), whole("guide_vertices"),
                            real("guide_vectors"), Floats(step, "guide_weights"), real("irregular_points"),
                            whole("irregular_valences"), real("irregular_directions"), (uint)o["face_count"], edge,
                            o["crease_angle"], (uint)o["relax_count"], real("symmetry_plane"));
                        return null;
                    }
                    ((Quads)on).Update(whole("crease_edges"), whole("guide_vertices"), real("guide_vectors"),
                        Floats(step, "guide_weights"), real("irregular_points"), whole("irregular_valences"),
                        real("irregular_directions"), (uint)o["face_count"], edge, o["crease_angle"],
                        (uint)o["relax_count"], real("symmetry_plane"));
                    return ((Quads)on).Mesh().Positions;
                }
            case "quads_info":
                {
                    return Fields(((Quads)on).Info);
                }
            case "quad_mesh": return ((Quads)on).Mesh().Positions;
            case "flow": objects[name] = new Flow(surface); return null;
            case "streamlines":
                {
                    Streamlines lines = ((Flow)on).Trace(Doubles(step, "field"), Numbers(Get(step, "seeds")),
                        Whole(step, "count"));
                    if (step.ContainsKey("lines")) Expect(lines.LineStarts.Length - 1 == Whole(step, "lines"),
                        (lines.LineStarts.Length - 1) + " lines");
                    return lines.Positions;
                }
            case "region": objects[name] = new Region(surface, Doubles(step, "positions"),
                (Base)Options(step, "base")["base"]); return null;
            case "weights": objects[name] = new Weights(surface, Doubles(step, "heads"), Doubles(step, "tails"), Doubles(step, "axes"),
                Numbers(Get(step, "parents")), Deforms(step), Numbers(Get(step, "sources")),
                influenceCount: (uint)Options(step, "influence_count")["influence_count"]); return null;
            case "set_joints": ((Weights)on).SetJoints(Doubles(step, "heads"), Doubles(step, "tails"), Doubles(step, "axes"),
                Numbers(Get(step, "parents")), Deforms(step), Numbers(Get(step, "sources"))); return null;
            case "set_pins": ((Weights)on).SetPins(vertices, joints: Numbers(Get(step, "joints")),
                weights: Floats(step, "weights"));
                return null;
            case "set_locks": ((Weights)on).SetLocks(Numbers(Get(step, "joints"))); return null;
            case "record_weights": ((Weights)on).Record(); return null;
            case "undo_weights": ((Weights)on).Undo(); return null;
            case "redo_weights": ((Weights)on).Redo(); return null;
            case "clone_weights": objects[name] = ((Weights)on).Clone(); return null;
            case "weights_info": return Fields(((Weights)on).Info);
            case "joint_flags": return ((Weights)on).Joints().Flags.Select(x => (double)x).ToArray();
            case "helpers": return ((Weights)on).Helpers(Names(step)).Select(x => (double)x).ToArray();
            case "skin_weights": return Column(((Weights)on).Get(), Whole(step, "joint"));
            case "transfer_weights":
                return Column(Weights.Transfer((Surface)objects[(string)step["source"]], surface, Numbers(Get(step, "joints")),
                    Floats(step, "weights")).Weights, Whole(step, "joint"));
            case "mirror":
                return Column(Weights.Mirror(surface, Doubles(step, "heads"), Names(step), plane: Doubles(step, "plane"),
                    joints: Numbers(Get(step, "joints")), weights: Floats(step, "weights"),
                    to: (MirrorTo)Whole(step, "to")).Weights, Whole(step, "joint"));
            case "region_edit":
                ((Region)on).Edit(Numbers(Get(step, "remove")), Numbers(Get(step, "add")),
                    Get(step, "rings") == null ? 0 : (int)(double)step["rings"], !step.ContainsKey("curve") ? null
                    : new CurveDesc { Vertices = Numbers(step["curve"]), Kind = (CurveKind)Whole(step, "curve_kind") });
                return null;
            case "region_info":
                return Fields(((Region)on).Info);
            case "region_vertices":
                return ((Region)on).Vertices((RegionList)Whole(step, "list")).Select(x => (double)x).ToArray();
            case "region_curve": return ((Region)on).Curve();
            case "record_region": ((Region)on).Record(); return null;
            case "undo_region": ((Region)on).Undo(); return null; case "redo_region": ((Region)on).Redo(); return null;
            case "morph":
                double weight = Number(step["weight"]);
                return on is Region ? ((Region)on).MorphDouble(weight) : ((Detail)on).MorphDouble(weight);
            case "detail":
                double scale = Options(step, "scale")["scale"];
                HfObject from = objects[(string)step["source"]], to = objects[(string)step["target"]];
                objects[name] = new Detail((Region)from, (Region)to, null, null, scale);
                return null;
            case "directions": return ((Direction)on).SolveDouble();
            case "singularities": return ((Direction)on).Singularities().Select(p => (double)p.Index).ToArray();
            case "pose": { var o = Options(step, "band_count");
                objects[name] = new Pose(surface, (uint)o["band_count"]); return null; }
            case "add_handles":
                bool inPlace = Flag(step, "in_place");
                return pose.AddHandles(Lists(Get(step, "regions")), points: Doubles(step, "points"),
                    radii: Doubles(step, "radii"), layer: Whole(step, "layer"), inPlace: inPlace);
            case "add_handle_at":
                return new[] { pose.AddHandleAt(Doubles(step, "point"), Number(step["radius"])) };
            case "set_transform":
                pose.SetTransform(Whole(step, "handle"), Doubles(step, "rotation"), Doubles(step, "translation"));
                return null;
            case "deform_f32":
                {
                    var posed = new float[3 * pose.VertexCount];
                    pose.Deform(posed);
                    return posed.Select(x => (double)x).ToArray();
                }
            case "remove_handles": pose.RemoveHandles(Numbers(Get(step, "handles"))); return null;
            case "set_transforms": pose.SetTransforms(Numbers(Get(step, "handles")), Doubles(step, "rotations"),
                Doubles(step, "translations")); return null;
            case "deform": { var o = Options(step, "restart", "iteration_count", "refine", "refine_from_last");
                return pose.DeformDouble((uint)o["iteration_count"], o["restart"] != 0, (int)o["refine"], o["refine_from_last"] != 0); }
            case "handle_field": return pose.Field(Whole(step, "handle")).Select(x => (double)x).ToArray();
            case "handle_info": return Fields(pose.Handle(Whole(step, "handle")));
            case "handle_place": return pose.Handle(Whole(step, "handle")).Rotation.Concat(
                pose.Handle(Whole(step, "handle")).Translation).ToArray();
            case "skin": return pose.Skin(Whole(step, "influence_count")).VertexWeights.Select(x => (double)x).ToArray();
            case "transfer": { var o = Options(step, "mode", "scale");
                objects[name] = new Transfer((Surface)objects[(string)step["source"]],
                (Surface)objects[(string)step["target"]], mode: (TransferMode)o["mode"], scale: o["scale"]); return null; }
            case "add_pairs": return transfer.AddPairs(Lists(Get(step, "source_regions")),
                Lists(Get(step, "target_regions")), Numbers(Get(step, "flags")));
            case "remove_pairs": transfer.RemovePairs(Numbers(Get(step, "pairs"))); return null;
            case "transfer_info": return Fields(transfer.Info);
            case "set_dials": { var o = Options(step, "stride", "hip_height_share", "neck_follow", "tail_follow", "arm_space",
                "long_follow");
                transfer.SetDials(o["stride"], o["hip_height_share"], o["neck_follow"], o["tail_follow"], o["arm_space"],
                    o["long_follow"]); return null; }
            case "dials": return Fields(transfer.Dials);
            case "apply": return transfer.ApplyDouble(Doubles(step, "positions"));
            default: throw new InvalidOperationException("unknown step " + what);
        }
    }

    public void Step(Map step)
    {
        object result;
        try { result = Run(step); }
        catch (HfException error)
        {
            // of two arrays that belong together, the library names the one that is missing; golden.cpp refuses the lone one
            bool lone = (string)Get(step, "error") == "HF_ERROR_INVALID_ARGUMENT" && error.Name == "HF_ERROR_NULL_POINTER"
                && error.Message.Contains("is NULL");
            Expect(lone || (string)Get(step, "error") == error.Name, "raised " + error.Message);
            Expect(!step.ContainsKey("index") || error.Index == Whole(step, "index"), "index " + error.Index);
            return;
        }
        Expect(!step.ContainsKey("error"), "did not fail with " + Get(step, "error"));
        if (result is double[])
        {
            var array = (double[])result;
            if (step.ContainsKey("expect")) Compare(array, (Map)step["expect"]);
            if (step.ContainsKey("same_as"))
                Expect(Bits(array).SequenceEqual(Bits((double[])kept[(string)step["same_as"]])),
                    "differs from " + step["same_as"]);
            if (step.ContainsKey("keep")) kept[(string)step["keep"]] = array;
        }
        else if (result is uint[] && step.ContainsKey("numbers"))
            Expect(((uint[])result).SequenceEqual(Numbers(step["numbers"])), "numbers");
        else if (result is Map && step.ContainsKey("expect"))
        {
            var wanted = (Map)step["expect"];
            foreach (var pair in wanted)
                if (pair.Key != "tolerance")
                    Expect(Math.Abs((double)((Map)result)[pair.Key]
                    - (double)pair.Value) <= (wanted.ContainsKey("tolerance") ? (double)wanted["tolerance"]
                    : 0), pair.Key + " is " + ((Map)result)[pair.Key]);
        }
    }
}

static class Program
{
    static int Main(string[] arguments)
    {
        var meshes = Directory.GetFiles(arguments[0], "*.json").ToDictionary(Path.GetFileNameWithoutExtension,
            path => (Map)Json.Parse(File.ReadAllText(path)));
        int failed = 0, wrongCalls = 0;
        foreach (string text in new[] { "{\"do\": \"nonsense\"}",
            "{\"do\": \"nonsense\", \"on\": \"nobody\", \"error\": \"HF_ERROR_EMPTY\"}" })
            try { new Scene(meshes).Step((Map)Json.Parse(text)); ++failed; Console.WriteLine("FAILED an unknown step passes: " + text); }
            catch (InvalidOperationException) { }
        foreach (string path in arguments.Skip(1))
            foreach (Map scene in (Items)((Map)Json.Parse(File.ReadAllText(path)))["scenes"])
            {
                var runner = new Scene(meshes);
                int place = 0;
                foreach (Map step in (Items)scene["steps"])
                {
                    if (step.ContainsKey("error")) ++wrongCalls;
                    try { runner.Step(step); }
                    catch (Mismatch mismatch) { ++failed;
                        Console.WriteLine("FAILED " + scene["name"] + ", step " + place + " (" + step["do"] + "): "
                        + mismatch.Message); }
                    ++place;
                }
                Console.WriteLine(scene["name"] + ": " + place + " steps");
            }
        Console.WriteLine(wrongCalls + " wrong calls answered");
        if (wrongCalls < 100) throw new Exception("too few wrong calls");
        Lifetime.Use(meshes["bar"]);
        Lifetime.Run();
        Lifetime.WrongArguments();
        Lifetime.Copies();
        return failed == 0 ? 0 : 1;
    }
}
