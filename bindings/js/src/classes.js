// Generated from include/hf/*.h by bindings/generate; do not edit. The classes, over a backend.

export function makeClasses({ Handle, Recorded, Call, bare, call, direct, handleOf, newHandle, none, read, scalar, written }) {

  const factorDesc = (c, prefix, options) => {
    const { bytes = null, ...more } = options;
    none(more);
    const desc = c.struct('hf_factor_desc', {});
    desc.set('bytes', c.array('bytes', bytes, 'u1', [prefix + 'byte_count'])).set('byte_count',
            c.n[prefix + 'byte_count']);
    return desc;
  };

  const linksDesc = (c, prefix, options) => {
    const { joints = null, weights = null, jointParents = null, tags = null, links = null, lightVertices = null,
            heavyVertices = null, mode = 0, distance = 0, stiffness = 0, overlayDistance = 0, ...more } = options;
    none(more);
    const desc = c.struct('hf_links_desc', { mode, distance, stiffness, overlay_distance: overlayDistance });
    desc.set('joints', c.array('joints', joints, 'u2', ['vertex_count', prefix + 'influence_count']));
    desc.set('weights', c.array('weights', weights, 'f4', ['vertex_count', prefix + 'influence_count']));
    desc.set('joint_parents', c.array('jointParents', jointParents, 'u4', [prefix + 'joint_count']));
    desc.set('tags', c.array('tags', tags, 'u4', ['vertex_count']));
    desc.set('links', c.rows('links', links, [prefix + 'link_count'], (row) => c.struct('hf_link', row)));
    desc.set('light_vertices', c.array('lightVertices', lightVertices, 'u4', [prefix + 'light_count']));
    desc.set('heavy_vertices', c.array('heavyVertices', heavyVertices, 'u4', [prefix + 'heavy_count']));
    desc.set('influence_count', (c.n[prefix + 'influence_count'] ??= 0));
    desc.set('link_count', (c.n[prefix + 'link_count'] ??= 0));
    desc.set('light_count', (c.n[prefix + 'light_count'] ??= 0));
    desc.set('heavy_count', (c.n[prefix + 'heavy_count'] ??= 0));
    desc.set('joint_count', (c.n[prefix + 'joint_count'] ??= 0));
    return desc;
  };

  const facesDesc = (c, prefix, options) => {
    const { corners = null, sizes = null, starts = null, ...more } = options;
    none(more);
    const desc = c.struct('hf_faces_desc', {});
    desc.set('corners', c.viewOf('hf_array', read, corners && c.numbers('corners', corners, 'u4', ['corner_count']),
            ['corner_count']));
    desc.set('sizes', c.viewOf('hf_array', read, sizes && c.numbers('sizes', sizes, 'u4', ['faces']), ['faces']));
    desc.set('starts', c.viewOf('hf_array', read, starts && c.numbers('starts', starts, 'u4',
            sizes ? ['faces'] : ['faces + 1']), sizes ? ['faces'] : ['faces + 1']));
    return desc;
  };

  const surfaceDesc = (c, prefix, options) => {
    const { positions = null, triangles = null, weld = 0, faces = null, weldTolerance = 0, operatorKind = 0,
            fieldKind = 0, ordering = 0, threadCount = 0, vertexLimit = 0, triangleLimit = 0, memoryLimitMb = 0,
            workLimitGflop = 0, progress = null, savedFactor = null, links = null, ...more } = options;
    none(more);
    const desc = c.struct('hf_surface_desc', { weld, weld_tolerance: weldTolerance, operator_kind: operatorKind,
            field_kind: fieldKind, ordering, thread_count: threadCount, vertex_limit: vertexLimit,
            triangle_limit: triangleLimit, memory_limit_mb: memoryLimitMb, work_limit_gflop: workLimitGflop });
    desc.set('positions', c.viewOf('hf_array', read, positions && c.numbers('positions', positions, 'f4 f8',
            ['vertex_count', 3]), ['vertex_count', 3]));
    desc.set('triangles', c.viewOf('hf_array', read, triangles && c.numbers('triangles', triangles, 'u4 u2',
            ['triangle_count', 3]), ['triangle_count', 3]));
    desc.set('progress', handleOf(progress, Progress, 'progress') || null);
    desc.set('faces', c.inner(faces, 'corners', facesDesc, 'faces.'));
    desc.set('saved_factor', c.inner(savedFactor, 'bytes', factorDesc, 'saved_factor.'));
    desc.set('links', c.inner(links, 'joints', linksDesc, 'links.'));
    return desc;
  };

  const graphDesc = (c, prefix, options) => {
    const { edges = null, weights = null, masses = null, vertexCount = 0, allowNegative = false, fieldKind = 0,
            ordering = 0, threadCount = 0, vertexLimit = 0, edgeLimit = 0, memoryLimitMb = 0, workLimitGflop = 0,
            progress = null, savedFactor = null, ...more } = options;
    none(more);
    const desc = c.struct('hf_graph_desc', { vertex_count: vertexCount, allow_negative: allowNegative,
            field_kind: fieldKind, ordering, thread_count: threadCount, vertex_limit: vertexLimit,
            edge_limit: edgeLimit, memory_limit_mb: memoryLimitMb, work_limit_gflop: workLimitGflop });
    if (scalar('u32', vertexCount, 'vertexCount')) c.n.vertex_count = vertexCount;
    desc.set('edges', c.viewOf('hf_array', read, edges && c.numbers('edges', edges, 'u4 u2', ['edge_count', 2]),
            ['edge_count', 2]));
    desc.set('weights', c.viewOf('hf_array', read, weights && c.numbers('weights', weights, 'f4 f8', ['edge_count']),
            ['edge_count']));
    desc.set('masses', c.viewOf('hf_array', read, masses && c.numbers('masses', masses, 'f4 f8', ['vertex_count']),
            ['vertex_count']));
    desc.set('progress', handleOf(progress, Progress, 'progress') || null);
    desc.set('saved_factor', c.inner(savedFactor, 'bytes', factorDesc, 'saved_factor.'));
    return desc;
  };

  const patchDesc = (c, prefix, options) => {
    const { removedTriangles = null, newPositions = null, newTriangles = null, cutEdges = null, ...more } = options;
    none(more);
    const desc = c.struct('hf_patch_desc', {});
    desc.set('removed_triangles', c.array('removedTriangles', removedTriangles, 'u4',
            [prefix + 'removed_triangle_count']));
    desc.set('new_positions', c.array('newPositions', newPositions, 'f8', [prefix + 'new_vertex_count', 3]));
    desc.set('new_triangles', c.array('newTriangles', newTriangles, 'u4', [prefix + 'new_triangle_count', 3]));
    desc.set('cut_edges', c.array('cutEdges', cutEdges, 'u4', [prefix + 'cut_edge_count', 2]));
    desc.set('removed_triangle_count', (c.n[prefix + 'removed_triangle_count'] ??= 0));
    desc.set('new_vertex_count', (c.n[prefix + 'new_vertex_count'] ??= 0));
    desc.set('new_triangle_count', (c.n[prefix + 'new_triangle_count'] ??= 0));
    desc.set('cut_edge_count', (c.n[prefix + 'cut_edge_count'] ??= 0));
    return desc;
  };

  const surfaceEditDesc = (c, prefix, options) => {
    const { vertices = null, stiffness = null, links = null, removedLinks = null, patch = null, progress = null,
            ...more } = options;
    none(more);
    const desc = c.struct('hf_surface_edit_desc', {});
    desc.set('vertices', c.array('vertices', vertices, 'u4', [prefix + 'vertex_count']));
    desc.set('stiffness', c.array('stiffness', stiffness, 'f8', [prefix + 'vertex_count']));
    desc.set('links', c.rows('links', links, [prefix + 'link_count'], (row) => c.struct('hf_link', row)));
    desc.set('removed_links', c.array('removedLinks', removedLinks, 'u4', [prefix + 'removed_link_count']));
    desc.set('progress', handleOf(progress, Progress, 'progress') || null);
    desc.set('patch', c.inner(patch, 'removedTriangles', patchDesc, 'patch.'));
    desc.set('vertex_count', (c.n[prefix + 'vertex_count'] ??= 0));
    desc.set('link_count', (c.n[prefix + 'link_count'] ??= 0));
    desc.set('removed_link_count', (c.n[prefix + 'removed_link_count'] ??= 0));
    return desc;
  };

  const cutDesc = (c, prefix, options) => {
    const { vertices = null, places = null, points = null, snapShare = 0, crossingLimit = 0, progress = null,
            ...more } = options;
    none(more);
    const desc = c.struct('hf_cut_desc', { snap_share: snapShare, crossing_limit: crossingLimit });
    desc.set('vertices', c.array('vertices', vertices, 'u4', [prefix + 'point_count']));
    desc.set('places', c.rows('places', places, [prefix + 'point_count'], c.place));
    desc.set('points', c.array('points', points, 'f8', [prefix + 'point_count', 3]));
    desc.set('progress', handleOf(progress, Progress, 'progress') || null);
    desc.set('point_count', (c.n[prefix + 'point_count'] ??= 0));
    return desc;
  };

  const pickDesc = (c, prefix, options) => {
    const { positions = null, frontOnly = false, ...more } = options;
    none(more);
    const desc = c.struct('hf_pick_desc', { front_only: frontOnly });
    desc.set('positions', c.viewOf('hf_array', read, positions && c.numbers('positions', positions, 'f4 f8',
            ['vertex_count', 3]), ['vertex_count', 3]));
    return desc;
  };

  const solverDesc = (c, prefix, options) => {
    const { fieldKind = 0, channelCount = 0, siteLimit = 0, progress = null, ...more } = options;
    none(more);
    const desc = c.struct('hf_solver_desc', { field_kind: fieldKind, channel_count: channelCount,
            site_limit: siteLimit });
    c.n.channel_count = scalar('u32', channelCount, 'channelCount') || 1;
    desc.set('progress', handleOf(progress, Progress, 'progress') || null);
    return desc;
  };

  const sitesDesc = (c, prefix, options) => {
    const { vertices = null, values = null, places = null, points = null, stiffness = null, radii = null,
            ...more } = options;
    none(more);
    const desc = c.struct('hf_sites_desc', {});
    desc.set('vertices', c.array('vertices', vertices, 'u4', [prefix + 'site_count']));
    desc.set('places', c.rows('places', places, [prefix + 'site_count'], c.place));
    desc.set('points', c.array('points', points, 'f8', [prefix + 'site_count', 3]));
    desc.set('values', c.array('values', values, 'f8', [prefix + 'site_count', 'channel_count']));
    desc.set('stiffness', c.array('stiffness', stiffness, 'f8', [prefix + 'site_count']));
    desc.set('radii', c.array('radii', radii, 'f8', [prefix + 'site_count']));
    desc.set('site_count', (c.n[prefix + 'site_count'] ??= 1));
    return desc;
  };

  const editDesc = (c, prefix, options) => {
    const { removeSites = null, moveSites = null, setSites = null, setValues = null, moveTo = null, add = null,
            ...more } = options;
    none(more);
    const desc = c.struct('hf_edit_desc', {});
    desc.set('remove_sites', c.array('removeSites', removeSites, 'u4', [prefix + 'remove_count']));
    desc.set('move_sites', c.array('moveSites', moveSites, 'u4', [prefix + 'move_count']));
    desc.set('set_sites', c.array('setSites', setSites, 'u4', [prefix + 'set_count']));
    desc.set('set_values', c.array('setValues', setValues, 'f8', [prefix + 'set_count', 'channel_count']));
    desc.set('move_to', c.inner(moveTo, 'vertices', sitesDesc, 'move_to.'));
    desc.set('add', c.inner(add, 'vertices', sitesDesc, 'add.'));
    desc.set('remove_count', (c.n[prefix + 'remove_count'] ??= 0));
    desc.set('move_count', (c.n[prefix + 'move_count'] ??= 0));
    desc.set('set_count', (c.n[prefix + 'set_count'] ??= 0));
    return desc;
  };

  const geodesicsDesc = (c, prefix, options) => {
    const { method = 0, smoothing = 0, progress = null, ...more } = options;
    none(more);
    const desc = c.struct('hf_geodesics_desc', { method, smoothing });
    desc.set('progress', handleOf(progress, Progress, 'progress') || null);
    return desc;
  };

  const extremitiesDesc = (c, prefix, options) => {
    const { kind = 0, leastLengthShare = 0, sourceCount = 0, geodesics = null, progress = null, ...more } = options;
    none(more);
    const desc = c.struct('hf_extremities_desc', { kind, least_length_share: leastLengthShare,
            source_count: sourceCount });
    c.n.source_count = scalar('u32', sourceCount, 'sourceCount') || 40;
    desc.set('geodesics', handleOf(geodesics, Geodesics, 'geodesics') || null);
    desc.set('progress', handleOf(progress, Progress, 'progress') || null);
    return desc;
  };

  const directionDesc = (c, prefix, options) => {
    const { degree = 0, siteLimit = 0, progress = null, ...more } = options;
    none(more);
    const desc = c.struct('hf_direction_desc', { degree, site_limit: siteLimit });
    desc.set('progress', handleOf(progress, Progress, 'progress') || null);
    return desc;
  };

  const poseDesc = (c, prefix, options) => {
    const { bandCount = 0, iterationCount = 0, groupCount = 0, ...more } = options;
    none(more);
    const desc = c.struct('hf_pose_desc', { band_count: bandCount, iteration_count: iterationCount,
            group_count: groupCount });
    return desc;
  };

  const handlesDesc = (c, prefix, options) => {
    const { regionVertices = null, vertices = null, places = null, points = null, radii = null, layer = 0,
            inPlace = false, freeRotation = false, progress = null, ...more } = options;
    none(more);
    const desc = c.struct('hf_handles_desc', { layer, in_place: inPlace, free_rotation: freeRotation });
    const regionVertices_ = c.lists('regionVertices', regionVertices, [prefix + 'handle_count']);
    desc.set('region_counts', regionVertices_[0]).set('region_vertices', regionVertices_[1]);
    desc.set('vertices', c.array('vertices', vertices, 'u4', [prefix + 'handle_count']));
    desc.set('places', c.rows('places', places, [prefix + 'handle_count'], c.place));
    desc.set('points', c.array('points', points, 'f8', [prefix + 'handle_count', 3]));
    desc.set('radii', c.array('radii', radii, 'f8', [prefix + 'handle_count']));
    desc.set('progress', handleOf(progress, Progress, 'progress') || null);
    desc.set('handle_count', (c.n[prefix + 'handle_count'] ??= 1));
    return desc;
  };

  const deformDesc = (c, prefix, options) => {
    const { iterationCount = 0, restart = false, refine = 0, refineFromLast = false, firstVertex = 0, vertexCount = 0,
            ...more } = options;
    none(more);
    const desc = c.struct('hf_deform_desc', { iteration_count: iterationCount, restart, refine,
            refine_from_last: refineFromLast, first_vertex: firstVertex, vertex_count: vertexCount });
    if (scalar('u32', vertexCount, 'vertexCount')) c.n.vertex_count = vertexCount;
    return desc;
  };

  const handleProposalsDesc = (c, prefix, options) => {
    const { joints = null, parents = null, skeleton = null, up = null, leastLengthShare = 0, limit = 0, progress = null,
            ...more } = options;
    none(more);
    const desc = c.struct('hf_handle_proposals_desc', { least_length_share: leastLengthShare, limit });
    desc.set('joints', c.array('joints', joints, 'f8', [prefix + 'joint_count', 3]));
    desc.set('parents', c.array('parents', parents, 'u4', [prefix + 'joint_count']));
    desc.set('up', up && c.numbers('up', up, 'f8', [3]));
    desc.set('skeleton', handleOf(skeleton, Skeleton, 'skeleton') || null);
    desc.set('progress', handleOf(progress, Progress, 'progress') || null);
    desc.set('joint_count', (c.n[prefix + 'joint_count'] ??= 0));
    return desc;
  };

  const quadsDesc = (c, prefix, options) => {
    const { creaseEdges = null, guideVertices = null, guideVectors = null, guideWeights = null, irregularPoints = null,
            irregularValences = null, irregularDirections = null, faceCount = 0, edgeLength = 0, creaseAngle = 0,
            relaxCount = 0, symmetryPlane = null, progress = null, ...more } = options;
    none(more);
    const desc = c.struct('hf_quads_desc', { face_count: faceCount, edge_length: edgeLength, crease_angle: creaseAngle,
            relax_count: relaxCount });
    desc.set('crease_edges', c.array('creaseEdges', creaseEdges, 'u4', [prefix + 'crease_count', 2]));
    desc.set('guide_vertices', c.array('guideVertices', guideVertices, 'u4', [prefix + 'guide_count']));
    desc.set('guide_vectors', c.array('guideVectors', guideVectors, 'f8', [prefix + 'guide_count', 3]));
    desc.set('guide_weights', c.array('guideWeights', guideWeights, 'f4', [prefix + 'guide_count']));
    desc.set('irregular_points', c.array('irregularPoints', irregularPoints, 'f8', [prefix + 'irregular_count', 3]));
    desc.set('irregular_valences', c.array('irregularValences', irregularValences, 'u4', [prefix + 'irregular_count']));
    desc.set('irregular_directions', c.array('irregularDirections', irregularDirections, 'f8',
            [prefix + 'irregular_count', 3]));
    desc.set('symmetry_plane', symmetryPlane && c.numbers('symmetryPlane', symmetryPlane, 'f8', [4]));
    desc.set('progress', handleOf(progress, Progress, 'progress') || null);
    desc.set('crease_count', (c.n[prefix + 'crease_count'] ??= 0));
    desc.set('guide_count', (c.n[prefix + 'guide_count'] ??= 0));
    desc.set('irregular_count', (c.n[prefix + 'irregular_count'] ??= 0));
    return desc;
  };

  const regionDesc = (c, prefix, options) => {
    const { positions = null, base = 0, progress = null, ...more } = options;
    none(more);
    const desc = c.struct('hf_region_desc', { base });
    desc.set('positions', c.viewOf('hf_array', read, positions && c.numbers('positions', positions, 'f4 f8',
            ['vertex_count', 3]), ['vertex_count', 3]));
    desc.set('progress', handleOf(progress, Progress, 'progress') || null);
    return desc;
  };

  const curveDesc = (c, prefix, options) => {
    const { vertices = null, places = null, points = null, side = 0, seedVertex = 0, kind = 0, ...more } = options;
    none(more);
    const desc = c.struct('hf_curve_desc', { side, seed_vertex: seedVertex, kind });
    desc.set('vertices', c.array('vertices', vertices, 'u4', [prefix + 'point_count']));
    desc.set('places', c.rows('places', places, [prefix + 'point_count'], c.place));
    desc.set('points', c.array('points', points, 'f8', [prefix + 'point_count', 3]));
    desc.set('point_count', (c.n[prefix + 'point_count'] ??= 0));
    return desc;
  };

  const regionEditDesc = (c, prefix, options) => {
    const { removeVertices = null, addVertices = null, ringCount = 0, curve = null, progress = null,
            ...more } = options;
    none(more);
    const desc = c.struct('hf_region_edit_desc', { ring_count: ringCount });
    desc.set('remove_vertices', c.array('removeVertices', removeVertices, 'u4', [prefix + 'remove_count']));
    desc.set('add_vertices', c.array('addVertices', addVertices, 'u4', [prefix + 'add_count']));
    desc.set('progress', handleOf(progress, Progress, 'progress') || null);
    desc.set('curve', c.inner(curve, 'vertices', curveDesc, 'curve.'));
    desc.set('remove_count', (c.n[prefix + 'remove_count'] ??= 0));
    desc.set('add_count', (c.n[prefix + 'add_count'] ??= 0));
    return desc;
  };

  const morphDesc = (c, prefix, options) => {
    const { weight = 0, ...more } = options;
    none(more);
    const desc = c.struct('hf_morph_desc', { weight });
    return desc;
  };

  const detailDesc = (c, prefix, options) => {
    const { sourceVertices = null, targetVertices = null, scale = 0, progress = null, ...more } = options;
    none(more);
    const desc = c.struct('hf_detail_desc', { scale });
    desc.set('source_vertices', c.array('sourceVertices', sourceVertices, 'u4', [prefix + 'pair_count']));
    desc.set('target_vertices', c.array('targetVertices', targetVertices, 'u4', [prefix + 'pair_count']));
    desc.set('progress', handleOf(progress, Progress, 'progress') || null);
    desc.set('pair_count', (c.n[prefix + 'pair_count'] ??= 0));
    return desc;
  };

  const retargetDesc = (c, prefix, options) => {
    const { sourceRest = null, targetRest = null, rootMotion = 0, leaveOut = 0, scale = 0, groundVelocity = null,
            progress = null, ...more } = options;
    none(more);
    const desc = c.struct('hf_retarget_desc', { root_motion: rootMotion, leave_out: leaveOut, scale });
    desc.set('source_rest', c.array('sourceRest', sourceRest, 'f4', ['source.joint_count', 10]));
    desc.set('target_rest', c.array('targetRest', targetRest, 'f4', ['target.joint_count', 10]));
    desc.set('ground_velocity', groundVelocity && c.numbers('groundVelocity', groundVelocity, 'f8', [3]));
    desc.set('progress', handleOf(progress, Progress, 'progress') || null);
    return desc;
  };

  const skinDesc = (c, prefix, options) => {
    const { positions = null, triangles = null, joints = null, weights = null, atRest = false, ...more } = options;
    none(more);
    const desc = c.struct('hf_skin_desc', { at_rest: atRest });
    desc.set('positions', c.array('positions', positions, 'f4', [prefix + 'vertex_count', 3]));
    desc.set('triangles', c.array('triangles', triangles, 'u4', [prefix + 'triangle_count', 3]));
    desc.set('joints', c.array('joints', joints, 'u4', [prefix + 'vertex_count', prefix + 'influence_count']));
    desc.set('weights', c.array('weights', weights, 'f4', [prefix + 'vertex_count', prefix + 'influence_count']));
    desc.set('vertex_count', (c.n[prefix + 'vertex_count'] ??= 0));
    desc.set('triangle_count', (c.n[prefix + 'triangle_count'] ??= 0));
    desc.set('influence_count', (c.n[prefix + 'influence_count'] ??= 0));
    return desc;
  };

  const skeletonDesc = (c, prefix, options) => {
    const { names = null, parents = null, rest = null, inverseBinds = null, up = null, forward = null, roles = null,
            sides = null, travels = null, skin = null, progress = null, ...more } = options;
    none(more);
    const desc = c.struct('hf_skeleton_desc', {});
    desc.set('parents', c.array('parents', parents, 'u4', [prefix + 'joint_count']));
    desc.set('rest', c.array('rest', rest, 'f4', [prefix + 'joint_count', 10]));
    desc.set('inverse_binds', c.array('inverseBinds', inverseBinds, 'f4', [prefix + 'joint_count', 16]));
    desc.set('up', c.array('up', up, 'f4', [3]));
    desc.set('forward', c.array('forward', forward, 'f4', [3]));
    desc.set('roles', c.array('roles', roles, 'i4', [prefix + 'joint_count']));
    desc.set('sides', c.array('sides', sides, 'i4', [prefix + 'joint_count']));
    desc.set('travels', c.array('travels', travels, 'f4', [prefix + 'travel_count', 3]));
    desc.set('names', c.text(names, 'names'));
    desc.set('progress', handleOf(progress, Progress, 'progress') || null);
    desc.set('skin', c.inner(skin, 'positions', skinDesc, 'skin.'));
    desc.set('joint_count', (c.n[prefix + 'joint_count'] ??= 0));
    desc.set('travel_count', (c.n[prefix + 'travel_count'] ??= 0));
    return desc;
  };

  const transferDesc = (c, prefix, options) => {
    const { sourceRest = null, targetRest = null, mode = 0, clusterCount = 0, ground = 0, kernelWidth = 0, scale = 0,
            alignmentAngle = 0, sourceAxes = null, targetAxes = null, ...more } = options;
    none(more);
    const desc = c.struct('hf_transfer_desc', { mode, cluster_count: clusterCount, ground, kernel_width: kernelWidth,
            scale, alignment_angle: alignmentAngle });
    desc.set('source_rest', c.viewOf('hf_array', read, sourceRest && c.numbers('sourceRest', sourceRest, 'f4 f8',
            ['source.vertex_count', 3]), ['source.vertex_count', 3]));
    desc.set('target_rest', c.viewOf('hf_array', read, targetRest && c.numbers('targetRest', targetRest, 'f4 f8',
            ['target.vertex_count', 3]), ['target.vertex_count', 3]));
    desc.set('source_axes', sourceAxes && c.numbers('sourceAxes', sourceAxes, 'f8', [9]));
    desc.set('target_axes', targetAxes && c.numbers('targetAxes', targetAxes, 'f8', [9]));
    return desc;
  };

  const pairsDesc = (c, prefix, options) => {
    const { sourceVertices = null, targetVertices = null, flags = null, progress = null, ...more } = options;
    none(more);
    const desc = c.struct('hf_pairs_desc', {});
    const sourceVertices_ = c.lists('sourceVertices', sourceVertices, [prefix + 'pair_count']);
    desc.set('source_counts', sourceVertices_[0]).set('source_vertices', sourceVertices_[1]);
    const targetVertices_ = c.lists('targetVertices', targetVertices, [prefix + 'pair_count']);
    desc.set('target_counts', targetVertices_[0]).set('target_vertices', targetVertices_[1]);
    desc.set('flags', c.array('flags', flags, 'u4', [prefix + 'pair_count']));
    desc.set('progress', handleOf(progress, Progress, 'progress') || null);
    desc.set('pair_count', (c.n[prefix + 'pair_count'] ??= 1));
    return desc;
  };

  const transferDials = (c, prefix, options) => {
    const { stride = 0, hipHeightShare = 0, neckFollow = 0, tailFollow = 0, armSpace = 0, longFollow = 0,
            ...more } = options;
    none(more);
    const desc = c.struct('hf_transfer_dials', { stride, hip_height_share: hipHeightShare, neck_follow: neckFollow,
            tail_follow: tailFollow, arm_space: armSpace, long_follow: longFollow });
    return desc;
  };

  const transferFrame = (c, prefix, options) => {
    const { sourcePositions = null, holdPairs = null, holdPositions = null, ...more } = options;
    none(more);
    const desc = c.struct('hf_transfer_frame', {});
    desc.set('source_positions', c.viewOf('hf_array', read, sourcePositions && c.numbers('sourcePositions',
            sourcePositions, 'f4 f8', ['source.vertex_count', 3]), ['source.vertex_count', 3]));
    desc.set('hold_pairs', c.array('holdPairs', holdPairs, 'u4', [prefix + 'hold_count']));
    desc.set('hold_positions', c.array('holdPositions', holdPositions, 'f8', [prefix + 'hold_count', 3]));
    desc.set('hold_count', (c.n[prefix + 'hold_count'] ??= 0));
    return desc;
  };

  const jointsDesc = (c, prefix, options) => {
    const { heads = null, tails = null, axes = null, parents = null, deforms = null, sources = null, progress = null,
            ...more } = options;
    none(more);
    const desc = c.struct('hf_joints_desc', {});
    desc.set('heads', c.array('heads', heads, 'f8', [prefix + 'joint_count', 3]));
    desc.set('tails', c.array('tails', tails, 'f8', [prefix + 'joint_count', 3]));
    desc.set('axes', c.array('axes', axes, 'f8', [prefix + 'joint_count', 3]));
    desc.set('parents', c.array('parents', parents, 'u4', [prefix + 'joint_count']));
    desc.set('deforms', c.array('deforms', deforms, 'i4', [prefix + 'joint_count']));
    desc.set('sources', c.array('sources', sources, 'u4', [prefix + 'joint_count']));
    desc.set('progress', handleOf(progress, Progress, 'progress') || null);
    desc.set('joint_count', (c.n[prefix + 'joint_count'] ??= 0));
    return desc;
  };

  const pinsDesc = (c, prefix, options) => {
    const { vertices = null, places = null, points = null, radii = null, joints = null, weights = null, progress = null,
            ...more } = options;
    none(more);
    const desc = c.struct('hf_pins_desc', {});
    desc.set('vertices', c.array('vertices', vertices, 'u4', [prefix + 'pin_count']));
    desc.set('places', c.rows('places', places, [prefix + 'pin_count'], c.place));
    desc.set('points', c.array('points', points, 'f8', [prefix + 'pin_count', 3]));
    desc.set('radii', c.array('radii', radii, 'f8', [prefix + 'pin_count']));
    desc.set('joints', c.array('joints', joints, 'u4', [prefix + 'pin_count', prefix + 'influence_count']));
    desc.set('weights', c.array('weights', weights, 'f4', [prefix + 'pin_count', prefix + 'influence_count']));
    desc.set('progress', handleOf(progress, Progress, 'progress') || null);
    desc.set('pin_count', (c.n[prefix + 'pin_count'] ??= 0));
    desc.set('influence_count', (c.n[prefix + 'influence_count'] ??= 0));
    return desc;
  };

  const weightsTransferDesc = (c, prefix, options) => {
    const { joints = null, weights = null, distance = 0, angle = 0, influenceCount = 0, progress = null,
            ...more } = options;
    none(more);
    const desc = c.struct('hf_weights_transfer_desc', { distance, angle, influence_count: influenceCount });
    c.n.influence_count = scalar('u32', influenceCount, 'influenceCount') || 4;
    desc.set('joints', c.array('joints', joints, 'u4', ['source.vertex_count', prefix + 'source_influence_count']));
    desc.set('weights', c.array('weights', weights, 'f4', ['source.vertex_count', prefix + 'source_influence_count']));
    desc.set('progress', handleOf(progress, Progress, 'progress') || null);
    desc.set('source_influence_count', (c.n[prefix + 'source_influence_count'] ??= 0));
    return desc;
  };

  const weightsMirrorDesc = (c, prefix, options) => {
    const { heads = null, names = null, partners = null, plane = null, joints = null, weights = null, to = 0,
            distance = 0, angle = 0, influenceCount = 0, progress = null, ...more } = options;
    none(more);
    const desc = c.struct('hf_weights_mirror_desc', { to, distance, angle, influence_count: influenceCount });
    c.n.influence_count = scalar('u32', influenceCount, 'influenceCount') || 4;
    desc.set('heads', c.array('heads', heads, 'f8', [prefix + 'joint_count', 3]));
    desc.set('partners', c.array('partners', partners, 'u4', [prefix + 'joint_count']));
    desc.set('plane', c.array('plane', plane, 'f8', [6]));
    desc.set('joints', c.array('joints', joints, 'u4', ['vertex_count', prefix + 'source_influence_count']));
    desc.set('weights', c.array('weights', weights, 'f4', ['vertex_count', prefix + 'source_influence_count']));
    desc.set('names', c.text(names, 'names'));
    desc.set('progress', handleOf(progress, Progress, 'progress') || null);
    desc.set('joint_count', (c.n[prefix + 'joint_count'] ??= 0));
    desc.set('source_influence_count', (c.n[prefix + 'source_influence_count'] ??= 0));
    return desc;
  };

  class Progress extends Handle {
    static destroy = 'hf_progress_destroy';
    static counts = [];

    constructor(first) {
      super();
      if (first === bare) return;
      const c = new Call(null);
      this._own('hf_progress_create', c);
    }

    get fraction() {
      const c = new Call(this);
      const fraction = new Float64Array(1);
      call('hf_progress_get_fraction', this._handle, written(fraction));
      return fraction[0];
    }

    cancel() {
      const c = new Call(this);
      call('hf_progress_cancel', this._handle);
    }
  }

  class Surface extends Handle {
    static destroy = 'hf_surface_destroy';
    static counts = ['vertex_count'];
    get vertexCount() {
      return this._n.vertex_count;
    }

    constructor(positions, triangles = null, options = {}) {
      super();
      if (positions === bare) return;
      const c = new Call(null);
      const desc = surfaceDesc(c, '', { positions, triangles, ...options });
      this._own('hf_surface_create', c, desc);
    }

    static fromGraph(edges = null, weights = null, options = {}) {
      const c = new Call(null);
      const desc = graphDesc(c, '', { edges, weights, ...options });
      const made = new this(bare);
      made._own('hf_surface_create_graph', c, desc);
      return made;
    }

    get info() {
      const c = new Call(this);
      const info = c.struct('hf_surface_info', {});
      call('hf_surface_get_info', this._handle, info);
      return info.toObject();
    }

    get report() {
      const c = new Call(this);
      const report = c.struct('hf_surface_report', {});
      call('hf_surface_get_report', this._handle, report);
      return report.toObject();
    }

    get meshStatistics() {
      const c = new Call(this);
      const statistics = c.struct('hf_mesh_statistics', {});
      call('hf_surface_get_mesh_statistics', this._handle, statistics);
      return statistics.toObject();
    }

    components() {
      const c = new Call(this);
      const count = new Uint32Array(1);
      const found = c.grow(this, 'hf_surface_get_components', (room, made) => call('hf_surface_get_components',
              this._handle, room.capacity, written(made.components), written(count)), () => ({ capacity: count[0] }),
              { capacity: null }, { components: ['u4', ['capacity']] });
      return found.components;
    }

    get linksInfo() {
      const c = new Call(this);
      const info = c.struct('hf_links_info', {});
      call('hf_surface_get_links_info', this._handle, info);
      return info.toObject();
    }

    links() {
      const c = new Call(this);
      const count = new Uint32Array(1);
      const found = c.grow(this, 'hf_surface_get_links', (room, made) => call('hf_surface_get_links', this._handle,
              room.capacity, written(made.links), written(count)), () => ({ capacity: count[0] }), { capacity: null },
              { links: ['hf_link', ['capacity']] });
      return found.links;
    }

    pieces() {
      const c = new Call(this);
      const count = new Uint32Array(1);
      const found = c.grow(this, 'hf_surface_get_pieces', (room, made) => call('hf_surface_get_pieces', this._handle,
              room.capacity, written(made.pieces), written(made.light), written(count)), () => ({ capacity: count[0] }),
              { capacity: null }, { pieces: ['u4', ['capacity']], light: ['i4', ['capacity']] });
      return { pieces: found.pieces, light: found.light };
    }

    measureGaps(positions) {
      const c = new Call(this);
      const info = Call.told(this, 'hf_gaps_info');
      const positions_ = c.viewOf('hf_array', read, positions && c.numbers('positions', positions, 'f4 f8',
              ['vertex_count', 3]), ['vertex_count', 3]);
      const found = c.grow(this, 'hf_surface_measure_gaps', (room, made) => call('hf_surface_measure_gaps',
              this._handle, positions === null || positions === undefined ? null : positions_, room.capacity,
              written(made.gaps), info), () => ({ capacity: info.get('link_count') }), { capacity: null },
              { gaps: ['f8', ['capacity']] });
      return found.gaps;
    }

    relink(options = {}) {
      const { progress = null, ...more } = options;
      const c = new Call(this);
      const desc = linksDesc(c, '', more);
      const made = new this.constructor(bare);
      Object.assign(c.n, this._n);
      made._own('hf_surface_relink', c, this._handle, desc, handleOf(progress, Progress, 'progress'));
      return made;
    }

    edit(options = {}) {
      const c = new Call(this);
      const desc = surfaceEditDesc(c, 'list_', options);
      const made = new this.constructor(bare);
      Object.assign(c.n, this._n);
      made._own('hf_surface_edit', c, this._handle, desc);
      made._n.vertex_count = made.info.vertexCount;
      return made;
    }

    cuts() {
      const c = new Call(this);
      const count = new Uint32Array(1);
      const found = c.grow(this, 'hf_surface_get_cuts', (room, made) => call('hf_surface_get_cuts', this._handle,
              room.capacity, written(made.cuts), written(count)), () => ({ capacity: count[0] }), { capacity: null },
              { cuts: ['hf_cut_corner', ['capacity']] });
      return found.cuts;
    }

    stiffness() {
      const c = new Call(this);
      const count = new Uint32Array(1);
      const found = c.grow(this, 'hf_surface_get_stiffness', (room, made) => call('hf_surface_get_stiffness',
              this._handle, room.capacity, written(made.stiffness), written(count)), () => ({ capacity: count[0] }),
              { capacity: null }, { stiffness: ['f8', ['capacity']] });
      return found.stiffness;
    }

    get statistics() {
      const c = new Call(this);
      const statistics = c.struct('hf_surface_statistics', {});
      call('hf_surface_get_statistics', this._handle, statistics);
      return statistics.toObject();
    }

    save(fieldKind = 0, options = {}) {
      const { progress = null, ...more } = options;
      none(more);
      const c = new Call(this);
      const size = newHandle();
      call('hf_surface_save', this._handle, fieldKind, handleOf(progress, Progress, 'progress'), 0, null,
              written(size));
      const block = new Uint8Array(Number(size[0]));
      call('hf_surface_save', this._handle, fieldKind, handleOf(progress, Progress, 'progress'), block.length,
              written(block), written(size));
      return block;
    }

    traceCut(options = {}) {
      const c = new Call(this);
      const desc = cutDesc(c, '', options);
      const cut = c.struct('hf_cut', {});
      const found = c.grow(this, 'hf_surface_trace_cut', (room, made) => (cut.set('removed_triangle_capacity',
              room.removed_triangle_capacity).set('new_vertex_capacity',
              room.new_vertex_capacity).set('new_triangle_capacity', room.new_triangle_capacity).set('rim_capacity',
              room.rim_capacity).set('removed_triangles', written(made.removedTriangles)).set('new_positions',
              written(made.newPositions)).set('new_triangles', written(made.newTriangles)).set('vertex_corners',
              written(made.vertexCorners)).set('vertex_barycentrics',
              written(made.vertexBarycentrics)).set('source_triangles',
              written(made.sourceTriangles)).set('corner_barycentrics',
              written(made.cornerBarycentrics)).set('rim_vertices', written(made.rimVertices)),
              call('hf_surface_trace_cut', this._handle, desc, cut)),
              () => ({ removed_triangle_capacity: cut.get('removed_triangle_count'),
              new_vertex_capacity: cut.get('new_vertex_count'), new_triangle_capacity: cut.get('new_triangle_count'),
              rim_capacity: cut.get('rim_count') }), { removed_triangle_capacity: null, new_vertex_capacity: null,
              new_triangle_capacity: null, rim_capacity: null }, { removedTriangles: ['u4',
              ['removed_triangle_capacity']], newPositions: ['f8', ['new_vertex_capacity', 3]], newTriangles: ['u4',
              ['new_triangle_capacity', 3]], vertexCorners: ['u4', ['new_vertex_capacity', 3]],
              vertexBarycentrics: ['f8', ['new_vertex_capacity', 3]], sourceTriangles: ['u4',
              ['new_triangle_capacity']], cornerBarycentrics: ['f8', ['new_triangle_capacity', 3, 3]],
              rimVertices: ['u4', ['rim_capacity', 2]] });
      return { ...found, removedTriangleCount: cut.get('removed_triangle_count'),
              newVertexCount: cut.get('new_vertex_count'), newTriangleCount: cut.get('new_triangle_count'),
              rimCount: cut.get('rim_count') };
    }

    castRay(origin, direction, options = {}) {
      const c = new Call(this);
      const origin_ = c.array('origin', origin, 'f8', [3]);
      const direction_ = c.array('direction', direction, 'f8', [3]);
      const desc = pickDesc(c, '', options);
      const hit = c.struct('hf_hit', {});
      call('hf_surface_cast_ray', this._handle, origin_, direction_, desc, hit);
      return hit.get('found') ? hit.toObject() : null;
    }

    findVertex(point, options = {}) {
      const c = new Call(this);
      const point_ = c.array('point', point, 'f8', [3]);
      const desc = pickDesc(c, '', options);
      const vertex = new Uint32Array(1);
      const distance = new Float64Array(1);
      call('hf_surface_find_vertex', this._handle, point_, desc, written(vertex), written(distance));
      return { vertex: vertex[0], distance: distance[0] };
    }

    spaceLevels(field, levelCount, spacing = 0) {
      const c = new Call(this);
      const field_ = c.viewOf('hf_array', read, field && c.numbers('field', field, 'f4 f8', ['vertex_count']),
              ['vertex_count']);
      if (scalar('u32', levelCount, 'levelCount')) c.n.level_count = levelCount;
      const levels = c.out(null, 'f8', ['level_count']);
      call('hf_surface_space_levels', this._handle, field === null || field === undefined ? null : field_, spacing,
              levelCount, written(levels));
      return levels;
    }

    traceIsolines(field, levels) {
      const c = new Call(this);
      const field_ = c.viewOf('hf_array', read, field && c.numbers('field', field, 'f4 f8', ['vertex_count']),
              ['vertex_count']);
      const levels_ = c.array('levels', levels, 'f8', ['level_count']);
      const lines = c.struct('hf_isolines', {});
      const found = c.grow(this, 'hf_surface_trace_isolines', (room, made) => (lines.set('point_capacity',
              room.point_capacity).set('line_capacity', room.line_capacity).set('point_edges',
              written(made.pointEdges)).set('parameters', written(made.parameters)).set('positions',
              written(made.positions)).set('line_starts', written(made.lineStarts)).set('line_levels',
              written(made.lineLevels)).set('line_closed', written(made.lineClosed)), call('hf_surface_trace_isolines',
              this._handle, field === null || field === undefined ? null : field_, (c.n.level_count ??= 1), levels_,
              lines)), () => ({ point_capacity: lines.get('point_count'), line_capacity: lines.get('line_count') }),
              { point_capacity: null, line_capacity: null }, { pointEdges: ['u4', ['point_capacity', 2]],
              parameters: ['f8', ['point_capacity']], positions: ['f8', ['point_capacity', 3]], lineStarts: ['u4',
              ['line_capacity + 1']], lineLevels: ['u4', ['line_capacity']], lineClosed: ['i4', ['line_capacity']] });
      return { ...found, pointCount: lines.get('point_count'), lineCount: lines.get('line_count') };
    }

    findCriticalPoints(field) {
      const c = new Call(this);
      const info = Call.told(this, 'hf_critical_info');
      const field_ = c.viewOf('hf_array', read, field && c.numbers('field', field, 'f4 f8', ['vertex_count']),
              ['vertex_count']);
      const found = c.grow(this, 'hf_surface_find_critical_points', (room,
              made) => call('hf_surface_find_critical_points', this._handle,
              field === null || field === undefined ? null : field_, room.capacity, written(made.points), info),
              () => ({ capacity: info.get('point_count') }), { capacity: null }, { points: ['hf_critical_point',
              ['capacity']] });
      return found.points;
    }

    findExtremities(options = {}) {
      const { field = null, ...more } = options;
      const c = new Call(this);
      const desc = extremitiesDesc(c, '', more);
      const field_ = field && c.out(field, 'f8', ['vertex_count'], null, 'field');
      desc.set('out_field', field_ && written(field_));
      const count = new Uint32Array(1);
      const found = c.grow(this, 'hf_surface_find_extremities', (room, made) => call('hf_surface_find_extremities',
              this._handle, desc, room.capacity, written(made.extremities), written(count)),
              () => ({ capacity: count[0] }), { capacity: null }, { extremities: ['hf_extremity', ['capacity']] });
      return found.extremities;
    }

    proposeHandles(options = {}) {
      const { regions = null, ...more } = options;
      const c = new Call(this);
      const desc = handleProposalsDesc(c, '', more);
      const regions_ = regions && c.out(regions, 'u4', ['vertex_count'], null, 'regions');
      desc.set('out_regions', regions_ && written(regions_));
      const count = new Uint32Array(1);
      const found = c.grow(this, 'hf_surface_propose_handles', (room, made) => call('hf_surface_propose_handles',
              this._handle, desc, room.capacity, written(made.proposals), written(count)),
              () => ({ capacity: count[0] }), { capacity: null }, { proposals: ['hf_handle_proposal', ['capacity']] });
      return found.proposals;
    }

    get gapsInfo() {
      return Call.told(this, 'hf_gaps_info').toObject();
    }

    get criticalInfo() {
      return Call.told(this, 'hf_critical_info').toObject();
    }
  }

  class Solver extends Recorded {
    static destroy = 'hf_solver_destroy';
    static counts = ['channel_count', 'vertex_count'];
    get channelCount() {
      return this._n.channel_count;
    }
    get vertexCount() {
      return this._n.vertex_count;
    }

    constructor(surface, options = {}) {
      super();
      if (surface === bare) return;
      const c = new Call(null, { surface });
      const desc = solverDesc(c, '', options);
      this._own('hf_create', c, handleOf(surface, Surface, 'surface'), desc);
    }

    clone() {
      const c = new Call(this);
      const made = new this.constructor(bare);
      Object.assign(c.n, this._n);
      made._own('hf_solver_clone', c, this._handle);
      return made;
    }

    moveTo(surface) {
      const c = new Call(this, { surface });
      call('hf_solver_move_to', this._handle, handleOf(surface, Surface, 'surface'));
      this._n.vertex_count = surface._n.vertex_count;
    }

    get info() {
      const c = new Call(this);
      const info = c.struct('hf_solver_info', {});
      call('hf_solver_get_info', this._handle, info);
      return info.toObject();
    }

    addSites(vertices = null, values = null, options = {}) {
      const c = new Call(this);
      const desc = sitesDesc(c, '', { vertices, values, ...options });
      const sites = c.out(null, 'u4', ['site_count']);
      call('hf_add_sites', this._handle, desc, written(sites));
      return sites;
    }

    addSite(vertex, values = null) {
      const c = new Call(this);
      const values_ = c.array('values', values, 'f8', ['channel_count']);
      const site = new Uint32Array(1);
      call('hf_solver_add_site', this._handle, vertex, values_, written(site));
      return site[0];
    }

    removeSites(sites) {
      const c = new Call(this);
      const sites_ = c.array('sites', sites, 'u4', ['site_count']);
      call('hf_remove_sites', this._handle, (c.n.site_count ??= 1), sites_);
    }

    moveSites(sites, vertices = null, values = null, options = {}) {
      const c = new Call(this);
      const sites_ = c.array('sites', sites, 'u4', ['site_count']);
      const desc = sitesDesc(c, '', { vertices, values, ...options });
      call('hf_solver_move_sites', this._handle, (c.n.site_count ??= 1), sites_, desc);
    }

    setValues(sites, values) {
      const c = new Call(this);
      const sites_ = c.array('sites', sites, 'u4', ['site_count']);
      const values_ = c.array('values', values, 'f8', ['site_count', 'channel_count']);
      call('hf_solver_set_values', this._handle, (c.n.site_count ??= 1), sites_, values_);
    }

    editSites(options = {}) {
      const c = new Call(this);
      const desc = editDesc(c, '', options);
      const sites = c.out(null, 'u4', ['add.site_count']);
      call('hf_solver_edit_sites', this._handle, desc, written(sites));
      return sites;
    }

    get siteCount() {
      return direct('hf_solver_get_site_count', this._handle);
    }

    sites() {
      const c = new Call(this);
      const info = c.struct('hf_sites_info', {});
      const found = c.grow(this, 'hf_solver_get_sites', (room, made) => (info.set('capacity',
              room.capacity).set('sites', written(made.sites)).set('vertices', written(made.vertices)).set('components',
              written(made.components)).set('values', written(made.values)).set('stiffness',
              written(made.stiffness)).set('flux', written(made.flux)).set('radii', written(made.radii)),
              call('hf_solver_get_sites', this._handle, info)), () => ({ capacity: info.get('count') }),
              { capacity: null }, { sites: ['u4', ['capacity']], vertices: ['u4', ['capacity']], components: ['u4',
              ['capacity']], values: ['f8', ['capacity', 'channel_count']], stiffness: ['f8', ['capacity']],
              flux: ['f8', ['capacity', 'channel_count']], radii: ['f8', ['capacity']] });
      return { ...found, count: info.get('count') };
    }

    setScreening(screening = null, targets = null) {
      const c = new Call(this);
      const screening_ = c.array('screening', screening, 'f8', ['vertex_count']);
      const targets_ = c.array('targets', targets, 'f8', ['vertex_count', 'channel_count']);
      call('hf_solver_set_screening', this._handle, screening_, targets_);
    }

    solve(out = null, options = {}) {
      const { Type = Float32Array, ...more } = options;
      none(more);
      const c = new Call(this);
      const info = Call.told(this, 'hf_solve_info');
      out = c.out(out, 'f4 f8', ['vertex_count', 'channel_count'], Type);
      const outView = c.viewOf('hf_array_out', written, out, ['vertex_count', 'channel_count']);
      call('hf_solver_solve', this._handle, outView, info);
      return out;
    }

    solveAt(vertices) {
      const c = new Call(this);
      delete c.n.vertex_count; // of the list given here
      const vertices_ = c.array('vertices', vertices, 'u4', ['vertex_count']);
      const values = c.out(null, 'f8', ['vertex_count', 'channel_count']);
      call('hf_solver_solve_at', this._handle, (c.n.vertex_count ??= 1), vertices_, written(values));
      return values;
    }

    solveVectors(out = null, options = {}) {
      const { Type = Float32Array, normals = null, ...more } = options;
      none(more);
      const c = new Call(this);
      const info = Call.told(this, 'hf_solve_info');
      out = c.out(out, 'f4 f8', ['vertex_count', 3], Type);
      const outView = c.viewOf('hf_array_out', written, out, ['vertex_count', 3]);
      const normals_ = normals && c.out(normals, 'f8', ['vertex_count', 3], null, 'normals');
      call('hf_solver_solve_vectors', this._handle, outView, written(normals), info);
      return out;
    }

    solvePreview(out = null, options = {}) {
      const { correctionCount = 0, Type = Float32Array, ...more } = options;
      none(more);
      const c = new Call(this);
      const info = Call.told(this, 'hf_preview_info');
      out = c.out(out, 'f4 f8', ['vertex_count', 'channel_count'], Type);
      const outView = c.viewOf('hf_array_out', written, out, ['vertex_count', 'channel_count']);
      call('hf_solver_solve_preview', this._handle, outView, correctionCount, info);
      return out;
    }

    releasePreview() {
      const c = new Call(this);
      call('hf_solver_release_preview', this._handle);
    }

    moveVectors(sites, vertices) {
      const c = new Call(this);
      const sites_ = c.array('sites', sites, 'u4', ['site_count']);
      const vertices_ = c.array('vertices', vertices, 'u4', ['site_count']);
      call('hf_solver_move_vectors', this._handle, (c.n.site_count ??= 1), sites_, vertices_);
    }

    rotateVectors(sites, angles) {
      const c = new Call(this);
      const sites_ = c.array('sites', sites, 'u4', ['site_count']);
      const angles_ = c.array('angles', angles, 'f8', ['site_count']);
      call('hf_solver_rotate_vectors', this._handle, (c.n.site_count ??= 1), sites_, angles_);
    }

    certify(options = {}) {
      const { tolerance = 0, ...more } = options;
      none(more);
      const c = new Call(this);
      const certificate = c.struct('hf_certificate', { tolerance });
      call('hf_solver_certify', this._handle, certificate);
      return certificate.toObject();
    }

    prepareRebase() {
      const c = new Call(this);
      call('hf_solver_prepare_rebase', this._handle);
    }

    get statistics() {
      const c = new Call(this);
      const statistics = c.struct('hf_solver_statistics', {});
      call('hf_solver_get_statistics', this._handle, statistics);
      return statistics.toObject();
    }

    get solveInfo() {
      return Call.told(this, 'hf_solve_info').toObject();
    }

    get previewInfo() {
      return Call.told(this, 'hf_preview_info').toObject();
    }
  }

  class Geodesics extends Handle {
    static destroy = 'hf_geodesics_destroy';
    static counts = ['vertex_count'];
    get vertexCount() {
      return this._n.vertex_count;
    }

    constructor(surface, options = {}) {
      super();
      if (surface === bare) return;
      const c = new Call(null, { surface });
      const desc = geodesicsDesc(c, '', options);
      this._own('hf_geodesics_create', c, handleOf(surface, Surface, 'surface'), desc);
    }

    solve(sources, out = null, options = {}) {
      const { Type = Float32Array, ...more } = options;
      none(more);
      const c = new Call(this);
      const sources_ = c.array('sources', sources, 'u4', ['source_count']);
      out = c.out(out, 'f4 f8', ['vertex_count'], Type);
      const outView = c.viewOf('hf_array_out', written, out, ['vertex_count']);
      call('hf_geodesics_solve', this._handle, (c.n.source_count ??= 1), sources_, outView);
      return out;
    }

    findPath(from, to) {
      const c = new Call(this);
      const path = c.struct('hf_path', {});
      const found = c.grow(this, 'hf_geodesics_find_path', (room, made) => (path.set('point_capacity',
              room.point_capacity).set('point_edges', written(made.pointEdges)).set('parameters',
              written(made.parameters)).set('positions', written(made.positions)), call('hf_geodesics_find_path',
              this._handle, c.place(from, 'from'), c.place(to, 'to'), path)),
              () => ({ point_capacity: path.get('point_count') }), { point_capacity: null }, { pointEdges: ['u4',
              ['point_capacity', 2]], parameters: ['f8', ['point_capacity']], positions: ['f8', ['point_capacity',
              3]] });
      return { ...found, pointCount: path.get('point_count'), length: path.get('length') };
    }

    map(centre, radius = 0) {
      const c = new Call(this);
      const map = c.out(null, 'f8', ['vertex_count', 2]);
      const frame = c.out(null, 'f8', [6]);
      call('hf_geodesics_get_map', this._handle, c.place(centre, 'centre'), radius, written(map), written(frame));
      return { map, frame };
    }
  }

  class Direction extends Recorded {
    static destroy = 'hf_direction_destroy';
    static counts = ['vertex_count'];
    get vertexCount() {
      return this._n.vertex_count;
    }

    constructor(surface, options = {}) {
      super();
      if (surface === bare) return;
      const c = new Call(null, { surface });
      const desc = directionDesc(c, '', options);
      this._own('hf_direction_create', c, handleOf(surface, Surface, 'surface'), desc);
    }

    clone() {
      const c = new Call(this);
      const made = new this.constructor(bare);
      Object.assign(c.n, this._n);
      made._own('hf_direction_clone', c, this._handle);
      return made;
    }

    addSites(vertices, vectors) {
      const c = new Call(this);
      const vertices_ = c.array('vertices', vertices, 'u4', ['site_count']);
      const vectors_ = c.array('vectors', vectors, 'f8', ['site_count', 3]);
      const sites = c.out(null, 'u4', ['site_count']);
      call('hf_direction_add_sites', this._handle, (c.n.site_count ??= 1), vertices_, vectors_, written(sites));
      return sites;
    }

    removeSites(sites) {
      const c = new Call(this);
      const sites_ = c.array('sites', sites, 'u4', ['site_count']);
      call('hf_direction_remove_sites', this._handle, (c.n.site_count ??= 1), sites_);
    }

    moveSites(sites, vertices) {
      const c = new Call(this);
      const sites_ = c.array('sites', sites, 'u4', ['site_count']);
      const vertices_ = c.array('vertices', vertices, 'u4', ['site_count']);
      call('hf_direction_move_sites', this._handle, (c.n.site_count ??= 1), sites_, vertices_);
    }

    setVectors(sites, vectors) {
      const c = new Call(this);
      const sites_ = c.array('sites', sites, 'u4', ['site_count']);
      const vectors_ = c.array('vectors', vectors, 'f8', ['site_count', 3]);
      call('hf_direction_set_vectors', this._handle, (c.n.site_count ??= 1), sites_, vectors_);
    }

    rotateSites(sites, angles) {
      const c = new Call(this);
      const sites_ = c.array('sites', sites, 'u4', ['site_count']);
      const angles_ = c.array('angles', angles, 'f8', ['site_count']);
      call('hf_direction_rotate_sites', this._handle, (c.n.site_count ??= 1), sites_, angles_);
    }

    get siteCount() {
      return direct('hf_direction_get_site_count', this._handle);
    }

    sites() {
      const c = new Call(this);
      const count = new Uint32Array(1);
      const found = c.grow(this, 'hf_direction_get_sites', (room, made) => call('hf_direction_get_sites', this._handle,
              room.capacity, written(made.sites), written(made.vertices), written(made.vectors), written(count)),
              () => ({ capacity: count[0] }), { capacity: null }, { sites: ['u4', ['capacity']], vertices: ['u4',
              ['capacity']], vectors: ['f8', ['capacity', 3]] });
      return { sites: found.sites, vertices: found.vertices, vectors: found.vectors };
    }

    solve(out = null, options = {}) {
      const { Type = Float32Array, ...more } = options;
      none(more);
      const c = new Call(this);
      const info = Call.told(this, 'hf_solve_info');
      out = c.out(out, 'f4 f8', ['vertex_count', 3], Type);
      const outView = c.viewOf('hf_array_out', written, out, ['vertex_count', 3]);
      call('hf_direction_solve', this._handle, outView, info);
      return out;
    }

    singularities() {
      const c = new Call(this);
      const count = new Uint32Array(1);
      const found = c.grow(this, 'hf_direction_get_singularities', (room,
              made) => call('hf_direction_get_singularities', this._handle, room.capacity, written(made.singularities),
              written(count)), () => ({ capacity: count[0] }), { capacity: null }, { singularities: ['hf_singularity',
              ['capacity']] });
      return found.singularities;
    }

    get statistics() {
      const c = new Call(this);
      const statistics = c.struct('hf_direction_statistics', {});
      call('hf_direction_get_statistics', this._handle, statistics);
      return statistics.toObject();
    }

    get solveInfo() {
      return Call.told(this, 'hf_solve_info').toObject();
    }
  }

  class Pose extends Recorded {
    static destroy = 'hf_pose_destroy';
    static counts = ['vertex_count'];
    get vertexCount() {
      return this._n.vertex_count;
    }

    constructor(surface, options = {}) {
      super();
      if (surface === bare) return;
      const c = new Call(null, { surface });
      const desc = poseDesc(c, '', options);
      this._own('hf_pose_create', c, handleOf(surface, Surface, 'surface'), desc);
    }

    clone() {
      const c = new Call(this);
      const made = new this.constructor(bare);
      Object.assign(c.n, this._n);
      made._own('hf_pose_clone', c, this._handle);
      return made;
    }

    moveTo(surface) {
      const c = new Call(this, { surface });
      call('hf_pose_move_to', this._handle, handleOf(surface, Surface, 'surface'));
      this._n.vertex_count = surface._n.vertex_count;
    }

    get info() {
      const c = new Call(this);
      const info = c.struct('hf_pose_info', {});
      call('hf_pose_get_info', this._handle, info);
      return info.toObject();
    }

    addHandles(regionVertices = null, options = {}) {
      const c = new Call(this);
      const desc = handlesDesc(c, '', { regionVertices, ...options });
      const handles = c.out(null, 'u4', ['handle_count']);
      call('hf_pose_add_handles', this._handle, desc, written(handles));
      return handles;
    }

    addHandleAt(point, radius) {
      const c = new Call(this);
      const point_ = c.array('point', point, 'f8', [3]);
      const handle = new Uint32Array(1);
      call('hf_pose_add_handle_at', this._handle, point_, radius, written(handle));
      return handle[0];
    }

    removeHandles(handles) {
      const c = new Call(this);
      const handles_ = c.array('handles', handles, 'u4', ['handle_count']);
      call('hf_pose_remove_handles', this._handle, (c.n.handle_count ??= 1), handles_);
    }

    setTransforms(handles, options = {}) {
      const { rotations = null, translations = null, ...more } = options;
      none(more);
      const c = new Call(this);
      const handles_ = c.array('handles', handles, 'u4', ['handle_count']);
      const rotations_ = rotations && c.numbers('rotations', rotations, 'f8', ['handle_count', 4]);
      const translations_ = translations && c.numbers('translations', translations, 'f8', ['handle_count', 3]);
      const transforms = c.rows('transforms', [...Array(c.product(['handle_count'])).keys()], ['handle_count'],
              (i) => c.struct('hf_transform', { rotation: rotations_?.subarray(4 * i, 4 * (i + 1)) ?? 0,
              translation: translations_?.subarray(3 * i, 3 * (i + 1)) ?? 0 }));
      call('hf_pose_set_transforms', this._handle, (c.n.handle_count ??= 1), handles_, transforms);
    }

    setTransform(handle, options = {}) {
      const { rotation = null, translation = null, ...more } = options;
      none(more);
      const c = new Call(this);
      const transform = c.struct('hf_transform', {});
      transform.set('rotation', rotation && c.numbers('rotation', rotation, 'f8', [4]));
      transform.set('translation', translation && c.numbers('translation', translation, 'f8', [3]));
      call('hf_pose_set_transform', this._handle, handle, transform);
    }

    setFreeRotations(handles, freeRotation = false) {
      const c = new Call(this);
      const handles_ = c.array('handles', handles, 'u4', ['handle_count']);
      call('hf_pose_set_free_rotations', this._handle, (c.n.handle_count ??= 1), handles_, freeRotation);
    }

    setFollowing(handles, following = 0) {
      const c = new Call(this);
      const handles_ = c.array('handles', handles, 'u4', ['handle_count']);
      call('hf_pose_set_following', this._handle, (c.n.handle_count ??= 1), handles_, following);
    }

    setLimbRefine(handles, refine = 0) {
      const c = new Call(this);
      const handles_ = c.array('handles', handles, 'u4', ['handle_count']);
      call('hf_pose_set_limb_refine', this._handle, (c.n.handle_count ??= 1), handles_, refine);
    }

    setRigidPieces(vertices) {
      const c = new Call(this);
      delete c.n.vertex_count; // of the list given here
      const vertices_ = c.array('vertices', vertices, 'u4', ['vertex_count']);
      call('hf_pose_set_rigid_pieces', this._handle, (c.n.vertex_count ??= 1), vertices_);
    }

    setMatrices(handles, matrices) {
      const c = new Call(this);
      const handles_ = c.array('handles', handles, 'u4', ['handle_count']);
      const matrices_ = c.array('matrices', matrices, 'f8', ['handle_count', 16]);
      call('hf_pose_set_matrices', this._handle, (c.n.handle_count ??= 1), handles_, matrices_);
    }

    handle(handle) {
      const c = new Call(this);
      const info = c.struct('hf_handle_info', {});
      call('hf_pose_get_handle', this._handle, handle, info);
      return info.toObject();
    }

    get handleCount() {
      return direct('hf_pose_get_handle_count', this._handle);
    }

    field(handle, out = null, options = {}) {
      const { Type = Float32Array, ...more } = options;
      none(more);
      const c = new Call(this);
      out = c.out(out, 'f4 f8', ['vertex_count'], Type);
      const outView = c.viewOf('hf_array_out', written, out, ['vertex_count']);
      call('hf_pose_get_field', this._handle, handle, outView);
      return out;
    }

    deform(out = null, options = {}) {
      const { Type = Float32Array, normals = null, ...more } = options;
      const c = new Call(this);
      const info = Call.told(this, 'hf_deform_info');
      const desc = deformDesc(c, '', more);
      out = c.out(out, 'f4 f8', ['vertex_count', 3], Type);
      desc.set('positions', out && c.viewOf('hf_array_out', written, out, ['vertex_count', 3]));
      const normals_ = normals && c.out(normals, 'f4 f8', ['vertex_count', 3], null, 'normals');
      desc.set('normals', normals_ && c.viewOf('hf_array_out', written, normals_, ['vertex_count', 3]));
      call('hf_pose_deform', this._handle, desc, info);
      return out;
    }

    get statistics() {
      const c = new Call(this);
      const statistics = c.struct('hf_pose_statistics', {});
      call('hf_pose_get_statistics', this._handle, statistics);
      return statistics.toObject();
    }

    skin(options = {}) {
      const { influenceCount = 0, scales = false, ...more } = options;
      none(more);
      const c = new Call(this);
      const skin = c.struct('hf_skin_info', { influence_count: influenceCount });
      c.n.influence_count = scalar('u32', influenceCount, 'influenceCount') || 4;
      const found = c.grow(this, 'hf_pose_get_skin', (room, made) => (skin.set('joint_capacity',
              room.joint_capacity).set('vertex_capacity', room.vertex_capacity).set('pivots',
              written(made.pivots)).set('rotations', written(made.rotations)).set('translations',
              written(made.translations)).set('axes', written(made.axes)).set('scales',
              written(made.scales)).set('vertex_joints', written(made.vertexJoints)).set('vertex_weights',
              written(made.vertexWeights)), call('hf_pose_get_skin', this._handle, skin)),
              () => ({ joint_capacity: skin.get('joint_count'), vertex_capacity: skin.get('vertex_count') }),
              { joint_capacity: c.n.joint_count, vertex_capacity: c.n.vertex_count }, { pivots: ['f8',
              ['joint_capacity', 3]], rotations: ['f8', ['joint_capacity', 4]], translations: ['f8', ['joint_capacity',
              3]], axes: ['f8', ['joint_capacity', 4]], ...(scales ? { scales: ['f8', ['joint_capacity', 3]] } : {}),
              vertexJoints: ['u4', ['vertex_capacity', 'influence_count']], vertexWeights: ['f4', ['vertex_capacity',
              'influence_count']] });
      return { ...found, jointCount: skin.get('joint_count'), vertexCount: skin.get('vertex_count') };
    }

    get blendInfo() {
      const c = new Call(this);
      const info = c.struct('hf_blend_info', {});
      call('hf_pose_get_blend_info', this._handle, info);
      return info.toObject();
    }

    blendRows() {
      const c = new Call(this);
      const rows = c.struct('hf_blend_rows', {});
      const found = c.grow(this, 'hf_pose_get_blend_rows', (room, made) => (rows.set('vertex_capacity',
              room.vertex_capacity).set('entry_capacity', room.entry_capacity).set('rows',
              written(made.rows)).set('clusters', written(made.clusters)).set('weights',
              written(made.weights)).set('gradients', written(made.gradients)).set('positions',
              written(made.positions)).set('normals', written(made.normals)).set('offsets', written(made.offsets)),
              call('hf_pose_get_blend_rows', this._handle, rows)), () => ({ vertex_capacity: rows.get('vertex_count'),
              entry_capacity: rows.get('entry_count') }), { vertex_capacity: c.n.vertex_count, entry_capacity: null },
              { rows: ['u4', ['vertex_capacity', 2]], clusters: ['u2', ['entry_capacity']], weights: ['f4',
              ['entry_capacity']], gradients: ['f4', ['entry_capacity', 3]], positions: ['f4', ['vertex_capacity', 3]],
              normals: ['f4', ['vertex_capacity', 3]], offsets: ['f4', ['vertex_capacity', 3]] });
      return { ...found, vertexCount: rows.get('vertex_count'), entryCount: rows.get('entry_count'),
              longestRow: rows.get('longest_row') };
    }

    blendInfluences(options = {}) {
      const { influenceCount = 0, byteClusters = false, byteWeights = false, ...more } = options;
      none(more);
      const c = new Call(this);
      const influences = c.struct('hf_blend_influences', { influence_count: influenceCount });
      c.n.influence_count = scalar('u32', influenceCount, 'influenceCount') || 8;
      const found = c.grow(this, 'hf_pose_get_blend_influences', (room, made) => (influences.set('vertex_capacity',
              room.vertex_capacity).set('clusters', written(made.clusters)).set('weights',
              written(made.weights)).set('byte_clusters', written(made.byteClusters)).set('byte_weights',
              written(made.byteWeights)), call('hf_pose_get_blend_influences', this._handle, influences)),
              () => ({ vertex_capacity: influences.get('vertex_count') }), { vertex_capacity: c.n.vertex_count },
              { clusters: ['u2', ['vertex_capacity', 'influence_count']], weights: ['u2', ['vertex_capacity',
              'influence_count']], ...(byteClusters ? { byteClusters: ['u1', ['vertex_capacity',
              'influence_count']] } : {}), ...(byteWeights ? { byteWeights: ['u1', ['vertex_capacity',
              'influence_count']] } : {}) });
      return { ...found, vertexCount: influences.get('vertex_count'), change: influences.get('change'),
              byteChange: influences.get('byte_change'), error: influences.get('error'),
              byteError: influences.get('byte_error') };
    }

    solve(iterationCount = 0, restart = false) {
      const c = new Call(this);
      const info = Call.told(this, 'hf_deform_info');
      call('hf_pose_solve', this._handle, iterationCount, restart, info);
    }

    blendTransforms() {
      const c = new Call(this);
      const count = new Uint32Array(1);
      const found = c.grow(this, 'hf_pose_get_blend_transforms', (room, made) => call('hf_pose_get_blend_transforms',
              this._handle, room.capacity, written(made.transforms), written(count)), () => ({ capacity: count[0] }),
              { capacity: null }, { transforms: ['f4', ['capacity', 12]] });
      return found.transforms;
    }

    get deformInfo() {
      return Call.told(this, 'hf_deform_info').toObject();
    }
  }

  class Quads extends Handle {
    static destroy = 'hf_quads_destroy';
    static counts = [];

    constructor(surface, options = {}) {
      super();
      if (surface === bare) return;
      const c = new Call(null, { surface });
      const desc = quadsDesc(c, '', options);
      this._own('hf_quads_create', c, handleOf(surface, Surface, 'surface'), desc);
    }

    update(options = {}) {
      const c = new Call(this);
      const desc = quadsDesc(c, '', options);
      call('hf_quads_update', this._handle, desc);
    }

    get info() {
      const c = new Call(this);
      const info = c.struct('hf_quads_info', {});
      call('hf_quads_get_info', this._handle, info);
      return info.toObject();
    }

    mesh() {
      const c = new Call(this);
      const mesh = c.struct('hf_quads_mesh', {});
      const found = c.grow(this, 'hf_quads_get_mesh', (room, made) => (mesh.set('vertex_capacity',
              room.vertex_capacity).set('face_capacity', room.face_capacity).set('positions',
              written(made.positions)).set('faces', written(made.faces)).set('triangles',
              written(made.triangles)).set('barycentrics', written(made.barycentrics)).set('corners',
              written(made.corners)), call('hf_quads_get_mesh', this._handle, mesh)),
              () => ({ vertex_capacity: mesh.get('vertex_count'), face_capacity: mesh.get('face_count') }),
              { vertex_capacity: c.n.vertex_count, face_capacity: null }, { positions: ['f8', ['vertex_capacity', 3]],
              faces: ['u4', ['face_capacity', 4]], triangles: ['u4', ['vertex_capacity']], barycentrics: ['f8',
              ['vertex_capacity', 3]], corners: ['u4', ['vertex_capacity', 3]] });
      return { ...found, vertexCount: mesh.get('vertex_count'), faceCount: mesh.get('face_count') };
    }
  }

  class Flow extends Handle {
    static destroy = 'hf_flow_destroy';
    static counts = ['vertex_count'];
    get vertexCount() {
      return this._n.vertex_count;
    }

    constructor(surface) {
      super();
      if (surface === bare) return;
      const c = new Call(null, { surface });
      this._own('hf_flow_create', c, handleOf(surface, Surface, 'surface'));
    }

    trace(field, options = {}) {
      const { seeds = null, wantedCount = 0, ...more } = options;
      none(more);
      const c = new Call(this);
      const field_ = c.viewOf('hf_array', read, field && c.numbers('field', field, 'f4 f8', ['vertex_count']),
              ['vertex_count']);
      const lines = c.struct('hf_streamlines', { wanted_count: wantedCount });
      lines.set('seeds', c.array('seeds', seeds, 'u4', ['seed_count']));
      lines.set('seed_count', (c.n['seed_count'] ??= 0));
      const found = c.grow(this, 'hf_flow_trace', (room, made) => (lines.set('point_capacity',
              room.point_capacity).set('line_capacity', room.line_capacity).set('positions',
              written(made.positions)).set('values', written(made.values)).set('line_starts',
              written(made.lineStarts)).set('line_ends', written(made.lineEnds)), call('hf_flow_trace', this._handle,
              field === null || field === undefined ? null : field_, lines)),
              () => ({ point_capacity: lines.get('point_count'), line_capacity: lines.get('line_count') }),
              { point_capacity: null, line_capacity: null }, { positions: ['f8', ['point_capacity', 3]], values: ['f8',
              ['point_capacity']], lineStarts: ['u4', ['line_capacity + 1']], lineEnds: ['u4', ['line_capacity', 2]] });
      return { ...found, pointCount: lines.get('point_count'), lineCount: lines.get('line_count') };
    }
  }

  class Region extends Recorded {
    static destroy = 'hf_region_destroy';
    static counts = ['vertex_count'];
    get vertexCount() {
      return this._n.vertex_count;
    }

    constructor(surface, options = {}) {
      super();
      if (surface === bare) return;
      const c = new Call(null, { surface });
      const desc = regionDesc(c, '', options);
      this._own('hf_region_create', c, handleOf(surface, Surface, 'surface'), desc);
    }

    clone() {
      const c = new Call(this);
      const made = new this.constructor(bare);
      Object.assign(c.n, this._n);
      made._own('hf_region_clone', c, this._handle);
      return made;
    }

    edit(options = {}) {
      const c = new Call(this);
      const desc = regionEditDesc(c, '', options);
      call('hf_region_edit', this._handle, desc);
    }

    get info() {
      const c = new Call(this);
      const info = c.struct('hf_region_info', {});
      call('hf_region_get_info', this._handle, info);
      return info.toObject();
    }

    get statistics() {
      const c = new Call(this);
      const statistics = c.struct('hf_region_statistics', {});
      call('hf_region_get_statistics', this._handle, statistics);
      return statistics.toObject();
    }

    vertices(list = 0) {
      const c = new Call(this);
      const count = new Uint32Array(1);
      const found = c.grow(this, 'hf_region_get_vertices', (room, made) => call('hf_region_get_vertices', this._handle,
              list, room.capacity, written(made.vertices), written(count)), () => ({ capacity: count[0] }),
              { capacity: null }, { vertices: ['u4', ['capacity']] });
      return found.vertices;
    }

    curve() {
      const c = new Call(this);
      const count = new Uint32Array(1);
      const found = c.grow(this, 'hf_region_get_curve', (room, made) => call('hf_region_get_curve', this._handle,
              room.capacity, written(made.points), written(count)), () => ({ capacity: count[0] }), { capacity: null },
              { points: ['f8', ['capacity', 3]] });
      return found.points;
    }

    morph(weight = 0, out = null, options = {}) {
      const { Type = Float32Array, normals = null, ...more } = options;
      const c = new Call(this);
      const desc = morphDesc(c, '', { weight, ...more });
      out = c.out(out, 'f4 f8', ['vertex_count', 3], Type);
      desc.set('positions', out && c.viewOf('hf_array_out', written, out, ['vertex_count', 3]));
      const normals_ = normals && c.out(normals, 'f4 f8', ['vertex_count', 3], null, 'normals');
      desc.set('normals', normals_ && c.viewOf('hf_array_out', written, normals_, ['vertex_count', 3]));
      call('hf_region_morph', this._handle, desc);
      return out;
    }
  }

  class Detail extends Handle {
    static destroy = 'hf_detail_destroy';
    static counts = ['vertex_count'];
    get vertexCount() {
      return this._n.vertex_count;
    }

    constructor(source, target, options = {}) {
      super();
      if (source === bare) return;
      const c = new Call(null, { source, target });
      const desc = detailDesc(c, '', options);
      this._own('hf_detail_create', c, handleOf(source, Region, 'source'), handleOf(target, Region, 'target'), desc);
    }

    morph(weight = 0, out = null, options = {}) {
      const { Type = Float32Array, normals = null, ...more } = options;
      const c = new Call(this);
      const desc = morphDesc(c, '', { weight, ...more });
      out = c.out(out, 'f4 f8', ['vertex_count', 3], Type);
      desc.set('positions', out && c.viewOf('hf_array_out', written, out, ['vertex_count', 3]));
      const normals_ = normals && c.out(normals, 'f4 f8', ['vertex_count', 3], null, 'normals');
      desc.set('normals', normals_ && c.viewOf('hf_array_out', written, normals_, ['vertex_count', 3]));
      call('hf_detail_morph', this._handle, desc);
      return out;
    }
  }

  class Retarget extends Recorded {
    static destroy = 'hf_retarget_destroy';
    static counts = ['joint_count'];
    get jointCount() {
      return this._n.joint_count;
    }

    constructor(source, target, options = {}) {
      super();
      if (source === bare) return;
      const c = new Call(null, { source, target });
      const desc = retargetDesc(c, '', options);
      this._own('hf_retarget_create', c, handleOf(source, Skeleton, 'source'), handleOf(target, Skeleton, 'target'),
              desc);
    }

    clone() {
      const c = new Call(this);
      const made = new this.constructor(bare);
      Object.assign(c.n, this._n);
      made._own('hf_retarget_clone', c, this._handle);
      return made;
    }

    solve(sourcePose, seconds = 0) {
      const c = new Call(this);
      const sourcePose_ = c.array('sourcePose', sourcePose, 'f4', ['source.joint_count', 10]);
      const targetPose = c.out(null, 'f4', ['target.joint_count', 10]);
      call('hf_retarget_solve', this._handle, sourcePose_, seconds, written(targetPose));
      return targetPose;
    }

    reset() {
      const c = new Call(this);
      call('hf_retarget_reset', this._handle);
    }

    get info() {
      const c = new Call(this);
      const info = c.struct('hf_retarget_info', {});
      call('hf_retarget_get_info', this._handle, info);
      return info.toObject();
    }

    chains() {
      const c = new Call(this);
      const count = new Uint32Array(1);
      const found = c.grow(this, 'hf_retarget_get_chains', (room, made) => call('hf_retarget_get_chains', this._handle,
              room.capacity, written(made.chains), written(count)), () => ({ capacity: count[0] }), { capacity: null },
              { chains: ['hf_chain_match', ['capacity']] });
      return found.chains;
    }

    partners() {
      const c = new Call(this);
      const count = new Uint32Array(1);
      const found = c.grow(this, 'hf_retarget_get_partners', (room, made) => call('hf_retarget_get_partners',
              this._handle, room.capacity, written(made.partners), written(count)), () => ({ capacity: count[0] }),
              { capacity: null }, { partners: ['u4', ['capacity']] });
      return found.partners;
    }
  }

  class Skeleton extends Handle {
    static destroy = 'hf_skeleton_destroy';
    static counts = ['joint_count'];
    get jointCount() {
      return this._n.joint_count;
    }

    groundVelocity(poses, seconds) {
      const c = new Call(this);
      const poses_ = c.array('poses', poses, 'f4', ['frame_count', 'joint_count', 10]);
      const velocity = c.out(null, 'f8', [3]);
      call('hf_skeleton_get_ground_velocity', this._handle, (c.n.frame_count ??= 1), poses_, seconds,
              written(velocity));
      return velocity;
    }

    constructor(names, parents = null, rest = null, options = {}) {
      super();
      if (names === bare) return;
      const c = new Call(null);
      const desc = skeletonDesc(c, '', { names, parents, rest, ...options });
      this._own('hf_skeleton_create', c, desc);
    }

    get info() {
      const c = new Call(this);
      const info = c.struct('hf_skeleton_info', {});
      call('hf_skeleton_get_info', this._handle, info);
      return info.toObject();
    }

    joints() {
      const c = new Call(this);
      const count = new Uint32Array(1);
      const found = c.grow(this, 'hf_skeleton_get_joints', (room, made) => call('hf_skeleton_get_joints', this._handle,
              room.capacity, written(made.joints), written(count)), () => ({ capacity: count[0] }), { capacity: null },
              { joints: ['hf_joint_info', ['capacity']] });
      return found.joints;
    }

    chains() {
      const c = new Call(this);
      const count = new Uint32Array(1);
      const found = c.grow(this, 'hf_skeleton_get_chains', (room, made) => call('hf_skeleton_get_chains', this._handle,
              room.capacity, written(made.chains), written(count)), () => ({ capacity: count[0] }), { capacity: null },
              { chains: ['hf_chain', ['capacity']] });
      return found.chains;
    }

    chainJoints() {
      const c = new Call(this);
      const count = new Uint32Array(1);
      const found = c.grow(this, 'hf_skeleton_get_chain_joints', (room, made) => call('hf_skeleton_get_chain_joints',
              this._handle, room.capacity, written(made.joints), written(count)), () => ({ capacity: count[0] }),
              { capacity: null }, { joints: ['u4', ['capacity']] });
      return found.joints;
    }

    reasons() {
      const c = new Call(this);
      const size = newHandle();
      call('hf_skeleton_get_reasons', this._handle, 0, null, written(size));
      const block = new Uint8Array(Number(size[0]));
      call('hf_skeleton_get_reasons', this._handle, block.length, written(block), written(size));
      return new TextDecoder().decode(block.subarray(0, -1));
    }
  }

  class Transfer extends Handle {
    static destroy = 'hf_transfer_destroy';
    static counts = ['vertex_count'];
    get vertexCount() {
      return this._n.vertex_count;
    }

    constructor(source, target, options = {}) {
      super();
      if (source === bare) return;
      const c = new Call(null, { source, target });
      const desc = transferDesc(c, '', options);
      this._own('hf_transfer_create', c, handleOf(source, Surface, 'source'), handleOf(target, Surface, 'target'),
              desc);
    }

    addPairs(sourceVertices = null, targetVertices = null, flags = null, options = {}) {
      const c = new Call(this);
      const desc = pairsDesc(c, '', { sourceVertices, targetVertices, flags, ...options });
      const pairs = c.out(null, 'u4', ['pair_count']);
      call('hf_transfer_add_pairs', this._handle, desc, written(pairs));
      return pairs;
    }

    removePairs(pairs) {
      const c = new Call(this);
      const pairs_ = c.array('pairs', pairs, 'u4', ['pair_count']);
      call('hf_transfer_remove_pairs', this._handle, (c.n.pair_count ??= 1), pairs_);
    }

    pair(pair) {
      const c = new Call(this);
      const info = c.struct('hf_pair_info', {});
      call('hf_transfer_get_pair', this._handle, pair, info);
      return info.toObject();
    }

    get info() {
      const c = new Call(this);
      const info = c.struct('hf_transfer_info', {});
      call('hf_transfer_get_info', this._handle, info);
      return info.toObject();
    }

    get statistics() {
      const c = new Call(this);
      const statistics = c.struct('hf_transfer_statistics', {});
      call('hf_transfer_get_statistics', this._handle, statistics);
      return statistics.toObject();
    }

    setDials(options = {}) {
      const c = new Call(this);
      const desc = transferDials(c, '', options);
      call('hf_transfer_set_dials', this._handle, desc);
    }

    get dials() {
      const c = new Call(this);
      const dials = c.struct('hf_transfer_dials', {});
      call('hf_transfer_get_dials', this._handle, dials);
      return dials.toObject();
    }

    setRigidPieces(vertices) {
      const c = new Call(this);
      delete c.n.vertex_count; // of the list given here
      const vertices_ = c.array('vertices', vertices, 'u4', ['vertex_count']);
      call('hf_transfer_set_rigid_pieces', this._handle, (c.n.vertex_count ??= 1), vertices_);
    }

    apply(sourcePositions = null, out = null, options = {}) {
      const { Type = Float32Array, targetNormals = null, ...more } = options;
      const c = new Call(this);
      const desc = transferFrame(c, '', { sourcePositions, ...more });
      out = c.out(out, 'f4 f8', ['target.vertex_count', 3], Type);
      desc.set('target_positions', out && c.viewOf('hf_array_out', written, out, ['target.vertex_count', 3]));
      const targetNormals_ = targetNormals && c.out(targetNormals, 'f4 f8', ['target.vertex_count', 3], null,
              'targetNormals');
      desc.set('target_normals', targetNormals_ && c.viewOf('hf_array_out', written, targetNormals_,
              ['target.vertex_count', 3]));
      call('hf_transfer_apply', this._handle, desc);
      return out;
    }

    sinking() {
      const c = new Call(this);
      const sinking = c.out(null, 'u1', ['target.vertex_count']);
      call('hf_transfer_get_sinking', this._handle, written(sinking));
      return sinking;
    }

    skin(options = {}) {
      const { influenceCount = 0, scales = false, ...more } = options;
      none(more);
      const c = new Call(this);
      const skin = c.struct('hf_skin_info', { influence_count: influenceCount });
      c.n.influence_count = scalar('u32', influenceCount, 'influenceCount') || 4;
      const found = c.grow(this, 'hf_transfer_get_skin', (room, made) => (skin.set('joint_capacity',
              room.joint_capacity).set('vertex_capacity', room.vertex_capacity).set('pivots',
              written(made.pivots)).set('rotations', written(made.rotations)).set('translations',
              written(made.translations)).set('axes', written(made.axes)).set('scales',
              written(made.scales)).set('vertex_joints', written(made.vertexJoints)).set('vertex_weights',
              written(made.vertexWeights)), call('hf_transfer_get_skin', this._handle, skin)),
              () => ({ joint_capacity: skin.get('joint_count'), vertex_capacity: skin.get('vertex_count') }),
              { joint_capacity: c.n.joint_count, vertex_capacity: c.n.vertex_count }, { pivots: ['f8',
              ['joint_capacity', 3]], rotations: ['f8', ['joint_capacity', 4]], translations: ['f8', ['joint_capacity',
              3]], axes: ['f8', ['joint_capacity', 4]], ...(scales ? { scales: ['f8', ['joint_capacity', 3]] } : {}),
              vertexJoints: ['u4', ['vertex_capacity', 'influence_count']], vertexWeights: ['f4', ['vertex_capacity',
              'influence_count']] });
      return { ...found, jointCount: skin.get('joint_count'), vertexCount: skin.get('vertex_count') };
    }
  }

  class Weights extends Recorded {
    static destroy = 'hf_weights_destroy';
    static counts = ['vertex_count'];
    get vertexCount() {
      return this._n.vertex_count;
    }

    constructor(surface, options = {}) {
      super();
      if (surface === bare) return;
      const { influenceCount = 0, ...more } = options;
      const c = new Call(null, { surface });
      const desc = jointsDesc(c, '', more);
      c.n.influence_count = scalar('u32', influenceCount, 'influenceCount') || 4;
      this._own('hf_weights_create', c, handleOf(surface, Surface, 'surface'), desc, influenceCount);
    }

    clone() {
      const c = new Call(this);
      const made = new this.constructor(bare);
      Object.assign(c.n, this._n);
      made._own('hf_weights_clone', c, this._handle);
      return made;
    }

    setJoints(options = {}) {
      const c = new Call(this);
      const desc = jointsDesc(c, '', options);
      call('hf_weights_set_joints', this._handle, desc);
    }

    setPins(vertices = null, options = {}) {
      const c = new Call(this);
      const desc = pinsDesc(c, '', { vertices, ...options });
      call('hf_weights_set_pins', this._handle, desc);
    }

    setLocks(joints, values = null) {
      const c = new Call(this);
      const joints_ = c.array('joints', joints, 'u4', ['lock_count']);
      const values_ = c.array('values', values, 'f4', ['vertex_count', 'lock_count']);
      call('hf_weights_set_locks', this._handle, (c.n.lock_count ??= 1), joints_, values_);
    }

    get() {
      const c = new Call(this);
      const weights = c.struct('hf_weights_out', {});
      const found = c.grow(this, 'hf_weights_get', (room, made) => (weights.set('vertex_capacity',
              room.vertex_capacity).set('joints', written(made.joints)).set('weights',
              written(made.weights)).set('origins', written(made.origins)), call('hf_weights_get', this._handle,
              weights)), () => ({ vertex_capacity: weights.get('vertex_count'),
              influence_count: weights.get('influence_count') }), { vertex_capacity: c.n.vertex_count },
              { joints: ['u4', ['vertex_capacity', 'influence_count']], weights: ['f4', ['vertex_capacity',
              'influence_count']], origins: ['u1', ['vertex_capacity']] });
      return { ...found, vertexCount: weights.get('vertex_count'), influenceCount: weights.get('influence_count') };
    }

    joints() {
      const c = new Call(this);
      const count = new Uint32Array(1);
      const found = c.grow(this, 'hf_weights_get_joints', (room, made) => call('hf_weights_get_joints', this._handle,
              room.capacity, written(made.flags), written(made.vertexCounts), written(count)),
              () => ({ capacity: count[0] }), { capacity: null }, { flags: ['u4', ['capacity']], vertexCounts: ['u4',
              ['capacity']] });
      return { flags: found.flags, vertexCounts: found.vertexCounts };
    }

    get info() {
      const c = new Call(this);
      const info = c.struct('hf_weights_info', {});
      call('hf_weights_get_info', this._handle, info);
      return info.toObject();
    }

    get statistics() {
      const c = new Call(this);
      const statistics = c.struct('hf_weights_statistics', {});
      call('hf_weights_get_statistics', this._handle, statistics);
      return statistics.toObject();
    }

    helpers(names = null) {
      const c = new Call(this);
      const count = new Uint32Array(1);
      const found = c.grow(this, 'hf_weights_get_helpers', (room, made) => call('hf_weights_get_helpers', this._handle,
              c.text(names, 'names'), room.capacity, written(made.reasons), written(count)),
              () => ({ capacity: count[0] }), { capacity: null }, { reasons: ['u4', ['capacity']] });
      return found.reasons;
    }

    static transfer(source, target, options = {}) {
      const c = new Call(null, { source, target });
      const info = c.struct('hf_weights_transfer_info', {});
      const desc = weightsTransferDesc(c, '', options);
      const weights_ = c.struct('hf_weights_out', {});
      const found = c.grow(source, 'hf_weights_transfer', (room, made) => (weights_.set('vertex_capacity',
              room.vertex_capacity).set('joints', written(made.joints)).set('weights',
              written(made.weights)).set('origins', written(made.origins)), call('hf_weights_transfer', handleOf(source,
              Surface, 'source'), handleOf(target, Surface, 'target'), desc, weights_, info)),
              () => ({ vertex_capacity: weights_.get('vertex_count'),
              influence_count: weights_.get('influence_count') }), { vertex_capacity: c.n.vertex_count },
              { joints: ['u4', ['vertex_capacity', 'influence_count']], weights: ['f4', ['vertex_capacity',
              'influence_count']], origins: ['u1', ['vertex_capacity']] });
      return { ...{ ...found, vertexCount: weights_.get('vertex_count'),
              influenceCount: weights_.get('influence_count') }, info: info.toObject() };
    }

    static mirror(surface, options = {}) {
      const c = new Call(null, { surface });
      const info = c.struct('hf_weights_mirror_info', {});
      const statistics = c.struct('hf_weights_mirror_statistics', {});
      const desc = weightsMirrorDesc(c, '', options);
      const weights_ = c.struct('hf_weights_out', {});
      const partners_ = c.out(null, 'u4', ['joint_count']);
      const pairings = c.out(null, 'u4', ['joint_count']);
      const found = c.grow(surface, 'hf_weights_mirror', (room, made) => (weights_.set('vertex_capacity',
              room.vertex_capacity).set('joints', written(made.joints)).set('weights',
              written(made.weights)).set('origins', written(made.origins)), call('hf_weights_mirror', handleOf(surface,
              Surface, 'surface'), desc, weights_, written(partners_), written(pairings), info, statistics)),
              () => ({ vertex_capacity: weights_.get('vertex_count'),
              influence_count: weights_.get('influence_count') }), { vertex_capacity: c.n.vertex_count },
              { joints: ['u4', ['vertex_capacity', 'influence_count']], weights: ['f4', ['vertex_capacity',
              'influence_count']], origins: ['u1', ['vertex_capacity']] });
      return { ...{ ...found, vertexCount: weights_.get('vertex_count'),
              influenceCount: weights_.get('influence_count') }, partners: partners_, pairings, info: info.toObject(),
              statistics: statistics.toObject() };
    }
  }

  return { Progress, Surface, Solver, Geodesics, Direction, Pose, Quads, Flow, Region, Detail, Retarget, Skeleton, Transfer, Weights };
}
