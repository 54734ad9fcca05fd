// The golden scenes (bindings/golden/README.md) through the JavaScript package. run(hf, meshes, scenes) works in node
// and in the browser and returns a list of failures. hear: gets the result of each step.
const camel = (name) => name.replace(/_([a-z0-9])/g, (_, letter) => letter.toUpperCase());

class Failure extends Error {}
const assert = (condition, message) => {
  if (!condition) throw new Failure(message);
};

function numbers(values) {
  if (Array.isArray(values)) return values.map(numbers);
  return { nan: NaN, inf: Infinity, '-inf': -Infinity }[values] ?? values;
}

function checkArray(array, expect) {
  const tolerance = expect.tolerance ?? 0;
  let [sum, weighted, min, max] = [0, 0, Infinity, -Infinity];
  array.forEach((value, i) => {
    assert(Number.isFinite(value), `[${i}] is ${value}`);
    sum += value;
    weighted += value * ((i % 7) + 1);
    min = Math.min(min, value);
    max = Math.max(max, value);
  });
  const n = array.length;
  if (n === 0) min = max = 0;
  const rows = {
    count: [n, 0],
    sum: [sum, tolerance * n],
    weighted: [weighted, 7 * tolerance * n],
    min: [min, tolerance],
    max: [max, tolerance],
  };
  // sums of many terms round differently from language to language
  for (const [key, [found, room]] of Object.entries(rows)) {
    if (key in expect)
      assert(
        Math.abs(found - expect[key]) <= room + (key === 'sum' || key === 'weighted' ? 1e-9 : 0),
        `${key} is ${found}, not ${expect[key]}`,
      );
  }
  (expect.at ?? []).forEach((place, k) =>
    assert(
      Math.abs(array[place] - expect.values[k]) <= tolerance,
      `[${place}] is ${array[place]}, not ${expect.values[k]}`,
    ),
  );
}

function checkStruct(info, expect) {
  for (const [key, value] of Object.entries(expect ?? {})) {
    if (key !== 'tolerance')
      assert(
        Math.abs(info[camel(key)] - value) <= (expect.tolerance ?? 0),
        `${key} is ${info[camel(key)]}, not ${value}`,
      );
  }
}

const bonesOf = (get, step) =>
  Object.fromEntries(
    ['heads', 'tails', 'axes', 'parents', 'deforms', 'sources'].filter((key) => key in step).map((key) => [key, get(key)]),
  );

/** The weight of one joint at every vertex. */
const placeOf = (list) =>
  list?.length === 6 ? { corners: list.slice(0, 3), barycentrics: list.slice(3) } : list?.[0];
const placesOf = (list) =>
  list && Array.from({ length: list.length / 6 }, (_, i) => placeOf(Array.from(list.slice(6 * i, 6 * i + 6))));
const columnOf = (found, joint) =>
  Float64Array.from(found.origins, (_, v) => {
    let sum = 0;
    for (let k = v * found.influenceCount; k < (v + 1) * found.influenceCount; ++k)
      if (found.joints[k] === joint) sum += found.weights[k];
    return sum;
  });

function runStep(hf, step, meshes, objects, kept) {
  const on = objects[step.on];
  const get = (key, otherwise = null) =>
    typeof step[key] === 'string' ? kept[step[key]] : numbers(step[key] ?? otherwise);
  const options = Object.fromEntries(
    Object.entries(step.options ?? {}).map(([key, value]) => [
      camel(key),
      typeof value === 'string' ? hf.constants[value] : value,
    ]),
  );
  const array = (value) => ({ array: value });
  switch (step.do) {
    case 'surface': {
      const mesh = step.mesh ? meshes[step.mesh] : { positions: null, triangles: null };
      const positions = mesh.positions && Float64Array.from(mesh.positions);
      const Corners = step.index_bits === 16 ? Uint16Array : Uint32Array;
      const triangles = step.no_triangles ? [] : mesh.triangles && Corners.from(mesh.triangles);
      for (const [key, value] of Object.entries(step.positions ?? {})) positions[key] = numbers(value);
      for (const [key, value] of Object.entries(step.triangles ?? {})) triangles[key] = value;
      let factor = step.factor ? kept[step.factor] : null;
      if (factor && 'damage' in step) {
        factor = factor.slice();
        factor[step.damage] ^= 1;
      }
      const faces = step.faces && { starts: step.faces.offsets, corners: step.faces.corners };
      objects[step.as] = new hf.Surface(positions, faces ? null : triangles, {
        ...options,
        faces,
        tags: get('tags'),
        savedFactor: factor,
      });
      return {};
    }
    case 'graph':
      objects[step.as] = hf.Surface.fromGraph(get('edges'), get('weights'), {
        ...options,
        vertexCount: step.vertex_count,
        masses: get('masses'),
      });
      return {};
    case 'solver':
      objects[step.as] = new hf.Solver(on, options);
      return {};
    case 'clone':
      objects[step.as] = on.clone();
      return {};
    case 'cut_surface': {
      const cut = on.traceCut({ places: placesOf(get('places')) });
      const { removedTriangles, newPositions, newTriangles } = cut;
      objects[step.as] = on.edit({ patch: { removedTriangles, newPositions, newTriangles } });
      const part = (list, width, i) => [...list.slice(width * i, width * (i + 1))];
      return {
        array: [...cut.sourceTriangles].flatMap((source, i) => [
          source,
          ...part(newTriangles, 3, i),
          ...part(cut.cornerBarycentrics, 9, i),
        ]),
      };
    }
    case 'edit_surface': {
      const rows = get('links') ?? [];
      const links = [...Array(rows.length / 8).keys()].map((i) => ({
        vertex: rows[8 * i],
        corners: rows.slice(8 * i + 1, 8 * i + 4),
        barycentrics: rows.slice(8 * i + 4, 8 * i + 7),
        weight: rows[8 * i + 7],
      }));
      objects[step.as] = on.edit({
        vertices: get('vertices'),
        stiffness: get('stiffness'),
        links: links.length ? links : null,
        removedLinks: get('removed_links'),
        patch: ['removed_triangles', 'new_positions', 'new_triangles', 'cut_edges'].some((name) => name in step)
          ? {
              removedTriangles: get('removed_triangles'),
              newPositions: get('new_positions'),
              newTriangles: get('new_triangles'),
              cutEdges: get('cut_edges'),
            }
          : null,
      });
      return {};
    }
    case 'cuts':
      return { array: on.cuts().flatMap((cut) => [cut.triangle, cut.corner, cut.vertex, cut.copied]) };
    case 'move_to':
      on.moveTo(objects[step.to]);
      return {};
    case 'dispose':
      on.close();
      return {};
    case 'add_sites':
      return {
        numbers: on.addSites(get('vertices'), get('values'), {
          stiffness: get('stiffness'),
          radii: get('radii'),
          places: placesOf(get('places')),
        }),
      };
    case 'add_site':
      return { numbers: [on.addSite(step.vertex, 'value' in step ? numbers(step.value) : null)] };
    case 'remove_sites':
      on.removeSites(get('sites'));
      return {};
    case 'move_sites':
      on.moveSites(get('sites'), get('vertices'));
      return {};
    case 'set_values':
      on.setValues(get('sites'), get('values'));
      return {};
    case 'edit':
      return {
        numbers: on.editSites({
          removeSites: get('remove', []),
          moveSites: get('move', []),
          moveTo: get('move_to'),
          setSites: get('set', []),
          setValues: get('set_values'),
          add: step.add && { vertices: get('add'), values: get('add_values') },
        }),
      };
    case 'record':
    case 'undo':
    case 'redo':
      on[step.do]();
      return {};
    case 'solve':
      return array(on.solve(null, { Type: Float64Array }));
    case 'solve_f32':
      return array(on.solve());
    case 'preview':
      return array(on.solvePreview(null, { correctionCount: step.correction_count ?? 0, Type: Float64Array }));
    case 'solve_at':
      return array(on.solveAt(get('vertices')));
    case 'report':
      return { struct: on.report };
    case 'statistics':
    case 'surface_statistics':
      return { struct: on.statistics };
    case 'components':
      return array(Float64Array.from(on.components()));
    case 'cast_ray': {
      const hit = on.castRay(get('origin'), get('direction'), {
        positions: get('positions'),
        frontOnly: step.front_only ?? 0,
      });
      return array(
        Float64Array.from(
          hit ? [1, hit.triangle, hit.vertex, ...hit.place.barycentrics, ...hit.position, hit.distance] : [0],
        ),
      );
    }
    case 'find_vertex': {
      const { vertex, distance } = on.findVertex(get('point'), { positions: get('positions') });
      return array(Float64Array.of(vertex, distance));
    }
    case 'certify':
      return { struct: on.certify({ tolerance: numbers(step.tolerance ?? 0) }) };
    case 'save':
      kept[step.as] = on.save(step.field_kind ?? 0);
      return {};
    case 'levels':
      return array(on.spaceLevels(get('field'), step.count, hf.constants[step.spacing]));
    case 'isolines': {
      const lines = on.traceIsolines(get('field'), get('levels'));
      if ('lines' in step)
        assert(
          lines.lineLevels.length === step.lines && lines.lineClosed.reduce((a, b) => a + b, 0) === step.closed,
          'lines',
        );
      return array(lines.positions);
    }
    case 'critical':
      return array(Float64Array.from(on.findCriticalPoints(get('field')), (point) => point.index));
    case 'propose':
      return array(Float64Array.from(on.proposeHandles(options), (place) => place.vertex).sort());
    case 'extremities':
      return array(Float64Array.from(on.findExtremities(options), (tip) => tip.vertex).sort());
    case 'geodesics':
      objects[step.as] = new hf.Geodesics(on, options);
      return {};
    case 'distance':
      return array(on.solve(get('sources'), null, { Type: Float64Array }));
    case 'path':
      return array(on.findPath(placeOf(get('from')), placeOf(get('to'))).positions);
    case 'map':
      return array(on.map(placeOf(get('centre')), numbers(step.radius ?? 0)).map);
    case 'direction':
      objects[step.as] = new hf.Direction(on, options);
      return {};
    case 'add_vectors':
      return { numbers: on.addSites(get('vertices'), get('vectors')) };
    case 'rotate':
      on.rotateSites(get('sites'), get('angles'));
      return {};
    case 'remove_vectors':
      on.removeSites(get('sites'));
      return {};
    case 'move_vectors':
      on.moveSites(get('sites'), get('vertices'));
      return {};
    case 'set_vectors':
      on.setVectors(get('sites'), get('vectors'));
      return {};
    case 'record_vectors':
    case 'undo_vectors':
    case 'redo_vectors':
      on[step.do.split('_')[0]]();
      return {};
    case 'clone_vectors':
      objects[step.as] = on.clone();
      return {};
    case 'vectors':
      return array(on.sites().vectors);
    case 'quads':
    case 'update_quads': {
      const more = 'edge_length' in step ? { edgeLength: numbers(step.edge_length) } : {};
      const given = {
        ...options,
        ...more,
        creaseEdges: get('crease_edges'),
        guideVertices: get('guide_vertices'),
        guideVectors: get('guide_vectors'),
        guideWeights: get('guide_weights'),
        irregularPoints: get('irregular_points'),
        irregularValences: get('irregular_valences'),
        irregularDirections: get('irregular_directions'),
        symmetryPlane: get('symmetry_plane'),
      };
      if (step.do === 'update_quads') {
        on.update(given);
        return array(on.mesh().positions);
      }
      objects[step.as] = new hf.Quads(on, given);
      return {};
    }
    case 'quads_info':
      return { struct: on.info };
    case 'quad_mesh':
      return array(on.mesh().positions);
    case 'flow':
      objects[step.as] = new hf.Flow(on);
      return {};
    case 'streamlines': {
      const lines = on.trace(get('field'), { wantedCount: step.count ?? 0, seeds: get('seeds') });
      const count = lines.lineStarts.length - 1;
      assert(count === (step.lines ?? count), `${count} lines`);
      return array(lines.positions);
    }
    case 'region':
      objects[step.as] = new hf.Region(on, { positions: get('positions'), ...options });
      return {};
    case 'weights':
      objects[step.as] = new hf.Weights(on, { ...bonesOf(get, step), ...options });
      return {};
    case 'set_joints':
      on.setJoints(bonesOf(get, step));
      return {};
    case 'set_pins':
      on.setPins(get('vertices'), { joints: get('joints'), weights: get('weights') });
      return {};
    case 'set_locks':
      on.setLocks(get('joints'));
      return {};
    case 'record_weights':
    case 'undo_weights':
    case 'redo_weights':
      on[step.do.split('_')[0]]();
      return {};
    case 'clone_weights':
      objects[step.as] = on.clone();
      return {};
    case 'joint_flags':
      return array(Float64Array.from(on.joints().flags));
    case 'helpers':
      return array(Float64Array.from(on.helpers(step.names ?? null)));
    case 'skin_weights':
      return array(columnOf(on.get(), step.joint));
    case 'transfer_weights': {
      const given = { joints: get('joints'), weights: get('weights') };
      return array(columnOf(hf.Weights.transfer(objects[step.source], on, given), step.joint));
    }
    case 'mirror': {
      const given = { joints: get('joints'), weights: get('weights') };
      const more = { names: step.names ?? null, plane: get('plane'), to: step.to ?? 0 };
      return array(columnOf(hf.Weights.mirror(on, { ...given, heads: get('heads'), ...more }), step.joint));
    }
    case 'region_edit':
      on.edit({
        curve: step.curve && { vertices: get('curve'), kind: step.curve_kind ?? 0 },
        ringCount: step.rings ?? 0,
        addVertices: get('add'),
        removeVertices: get('remove'),
      });
      return {};
    case 'surface_info':
    case 'solver_info':
    case 'pose_info':
    case 'transfer_info':
    case 'weights_info':
    case 'region_info':
      return { struct: on.info };
    case 'region_vertices':
      return array(Float64Array.from(on.vertices(step.list ?? 0)));
    case 'region_curve':
      return array(on.curve());
    case 'record_region':
    case 'undo_region':
    case 'redo_region':
      on[step.do.split('_')[0]]();
      return {};
    case 'morph':
      return array(on.morph(numbers(step.weight), null, { Type: Float64Array }));
    case 'detail':
      objects[step.as] = new hf.Detail(objects[step.source], objects[step.target], options);
      return {};
    case 'directions':
      return array(on.solve(null, { Type: Float64Array }));
    case 'singularities':
      return array(Float64Array.from(on.singularities(), (s) => s.index));
    case 'pose':
      objects[step.as] = new hf.Pose(on, options);
      return {};
    case 'add_handles':
      return {
        numbers: on.addHandles(get('regions'), {
          points: get('points'),
          radii: get('radii'),
          layer: step.layer ?? 0,
          inPlace: step.in_place ?? false,
        }),
      };
    case 'add_handle_at':
      return { numbers: [on.addHandleAt(get('point'), numbers(step.radius))] };
    case 'remove_handles':
      on.removeHandles(get('handles'));
      return {};
    case 'set_transforms':
      on.setTransforms(get('handles'), { rotations: get('rotations'), translations: get('translations') });
      return {};
    case 'set_transform':
      on.setTransform(step.handle, { rotation: get('rotation'), translation: get('translation') });
      return {};
    case 'deform_f32':
      return array(on.deform());
    case 'deform':
      return array(on.deform(null, { Type: Float64Array, ...options }));
    case 'handle_field':
      return array(on.field(step.handle));
    case 'handle_info':
      return { struct: on.handle(step.handle) };
    case 'handle_place': {
      const { rotation, translation } = on.handle(step.handle);
      return array(Float64Array.from([...rotation, ...translation]));
    }
    case 'skin': {
      const skin = on.skin({ influenceCount: step.influence_count });
      assert(skin.jointCount >= 2, `${skin.jointCount} joints`);
      return array(skin.vertexWeights);
    }
    case 'transfer':
      objects[step.as] = new hf.Transfer(objects[step.source], objects[step.target], options);
      return {};
    case 'add_pairs':
      return { numbers: on.addPairs(get('source_regions'), get('target_regions'), get('flags')) };
    case 'remove_pairs':
      on.removePairs(get('pairs'));
      return {};
    case 'set_dials':
      on.setDials(options);
      return {};
    case 'dials':
      return { struct: on.dials };
    case 'apply':
      return array(on.apply(get('positions'), null, { Type: Float64Array }));
    default:
      throw new Error(`unknown step ${step.do}`);
  }
}

function checkStep(hf, step, meshes, objects, kept, hear) {
  let result;
  try {
    result = runStep(hf, step, meshes, objects, kept);
  } catch (error) {
    if (!(error instanceof hf.HfError)) throw error;
    // of two arrays that belong together, the library names the one that is missing; golden.cpp refuses the lone one
    const lone = step.error === 'HF_ERROR_INVALID_ARGUMENT' && error.codeName === 'HF_ERROR_NULL_POINTER' && /is NULL/.test(error.message);
    assert(lone || error.codeName === step.error, `raised ${error.message}`);
    assert(!('index' in step) || error.index === step.index, `index ${error.index}: ${error.message}`);
    return;
  }
  assert(!step.error, `did not fail with ${step.error}`);
  hear?.(result);
  if (result.array) {
    if (step.expect) checkArray(result.array, step.expect);
    if (step.same_as)
      assert(
        result.array.every((value, i) => Object.is(value, kept[step.same_as][i])),
        `differs from ${step.same_as}`,
      );
    if (step.keep) kept[step.keep] = result.array;
  } else if (result.numbers && step.numbers) {
    assert(JSON.stringify([...result.numbers]) === JSON.stringify(step.numbers), `numbers ${[...result.numbers]}`);
  } else if (result.struct) {
    checkStruct(result.struct, step.expect);
  }
}

export function run(hf, meshes, scenes, hear) {
  const failures = [];
  for (const step of [{ do: 'nonsense' }, { do: 'nonsense', on: 'nobody', error: 'HF_ERROR_EMPTY' }]) {
    try {
      checkStep(hf, step, meshes, {}, {});
      failures.push(`an unknown step passes: ${JSON.stringify(step)}`);
    } catch (error) {
      if (!/unknown step/.test(error.message)) throw error;
    }
  }
  for (const scene of scenes) {
    const [objects, kept] = [{}, {}];
    scene.steps.forEach((step, place) => {
      try {
        checkStep(hf, step, meshes, objects, kept, hear);
      } catch (error) {
        failures.push(
          `${scene.name}, step ${place} (${step.do}): ${error instanceof Failure ? error.message : error.stack}`,
        );
      }
    });
  }
  return failures;
}
