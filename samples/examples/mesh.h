/* A mesh for the examples: read from an OBJ file, or a built-in creature's leg; written as OBJ. */
#ifndef HF_EXAMPLES_MESH_H
#define HF_EXAMPLES_MESH_H

#include <hf/hf.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct Mesh {
  uint32_t vertex_count, triangle_count;
  float* positions;    /* [vertex_count][3] */
  uint32_t* triangles; /* [triangle_count][3] */
} Mesh;

/* Ends the program with the library's own sentence when a call failed. */
static void ok(hf_result result) {
  hf_error_detail detail;
  if (result == HF_OK) return;
  hf_error_get_detail(&detail);
  fprintf(stderr, "%s: %s\n", detail.function, detail.message);
  exit(1);
}

static void* grown(void* block, size_t bytes) {
  void* larger = realloc(block, bytes);
  if (!larger) exit(2);
  return larger;
}

static void mesh_add_vertex(Mesh* mesh, float x, float y, float z) {
  mesh->positions = (float*)grown(mesh->positions, sizeof(float) * 3 * ((size_t)mesh->vertex_count + 1));
  float* p = mesh->positions + 3 * (size_t)mesh->vertex_count++;
  p[0] = x;
  p[1] = y;
  p[2] = z;
}

static void mesh_add_triangle(Mesh* mesh, uint32_t a, uint32_t b, uint32_t c) {
  mesh->triangles = (uint32_t*)grown(mesh->triangles, sizeof(uint32_t) * 3 * ((size_t)mesh->triangle_count + 1));
  uint32_t* corner = mesh->triangles + 3 * (size_t)mesh->triangle_count++;
  corner[0] = a;
  corner[1] = b;
  corner[2] = c;
}

/* A leg along y from 0 to 4, open at both ends: 32 vertices on each of 81 rings, thicker in the middle. */
static Mesh mesh_leg(void) {
  const uint32_t around = 32, rings = 81;
  Mesh mesh = {0, 0, NULL, NULL};
  for (uint32_t r = 0; r < rings; ++r) {
    const float y = 4.0f * (float)r / (float)(rings - 1), radius = 0.35f + 0.15f * sinf(0.8f * y);
    for (uint32_t i = 0; i < around; ++i) {
      const float angle = 6.2831853f * (float)i / (float)around;
      mesh_add_vertex(&mesh, radius * cosf(angle), y, radius * sinf(angle));
    }
  }
  for (uint32_t r = 0; r + 1 < rings; ++r) {
    for (uint32_t i = 0; i < around; ++i) {
      const uint32_t a = r * around + i, b = r * around + (i + 1) % around;
      mesh_add_triangle(&mesh, a, a + around, b);
      mesh_add_triangle(&mesh, b, a + around, b + around);
    }
  }
  return mesh;
}

/* Reads "v" and "f" lines of an OBJ file; polygons become fans. Without a file: the leg. */
static Mesh mesh_load(int argc, char** argv) {
  Mesh mesh = {0, 0, NULL, NULL};
  char line[1024];
  if (argc < 2) return mesh_leg();
  FILE* file = fopen(argv[1], "r");
  if (!file) {
    fprintf(stderr, "cannot open %s\n", argv[1]);
    exit(1);
  }
  while (fgets(line, sizeof line, file)) {
    float x, y, z;
    if (sscanf(line, "v %f %f %f", &x, &y, &z) == 3) mesh_add_vertex(&mesh, x, y, z);
    if (strncmp(line, "f ", 2) != 0) continue;
    uint32_t corner[3], count = 0;
    for (char* at = line + 1; (at = strchr(at, ' ')) != NULL && sscanf(at, "%u", &corner[count < 2 ? count : 2]) == 1;
         ++at) {
      if (++count < 3) continue;
      mesh_add_triangle(&mesh, corner[0] - 1, corner[1] - 1, corner[2] - 1);
      corner[1] = corner[2];
    }
  }
  fclose(file);
  return mesh;
}

static void mesh_save(const Mesh* mesh, const float* positions, const char* name) {
  FILE* file = fopen(name, "w");
  if (!file) {
    fprintf(stderr, "cannot write %s\n", name);
    exit(1);
  }
  for (size_t v = 0; v < mesh->vertex_count; ++v)
    fprintf(file, "v %g %g %g\n", (double)positions[3 * v], (double)positions[3 * v + 1], (double)positions[3 * v + 2]);
  for (size_t t = 0; t < mesh->triangle_count; ++t) {
    const uint32_t* corner = mesh->triangles + 3 * t;
    fprintf(file, "f %u %u %u\n", corner[0] + 1, corner[1] + 1, corner[2] + 1);
  }
  const int failed = ferror(file);
  if (fclose(file) != 0 || failed) {
    fprintf(stderr, "cannot write %s\n", name);
    exit(1);
  }
  printf("wrote %s\n", name);
}

static void mesh_free(Mesh* mesh) {
  free(mesh->positions);
  free(mesh->triangles);
}

/* The surface of a mesh. */
static hf_surface mesh_surface(const Mesh* mesh) {
  hf_surface_desc desc = HF_INIT(hf_surface_desc);
  hf_surface surface;
  desc.positions = HF_ARRAY(mesh->positions, mesh->vertex_count);
  desc.triangles = HF_ARRAY(mesh->triangles, mesh->triangle_count);
  ok(hf_surface_create(&desc, &surface));
  return surface;
}

/* The lowest and the highest corner of a triangle along y. */
static void mesh_ends(const Mesh* mesh, double low[3], double high[3]) {
  const float *lowest = mesh->positions + 3 * (size_t)mesh->triangles[0], *highest = lowest;
  for (size_t i = 0; i < 3 * (size_t)mesh->triangle_count; ++i) {
    const float* p = mesh->positions + 3 * (size_t)mesh->triangles[i];
    if (p[1] < lowest[1]) lowest = p;
    if (p[1] > highest[1]) highest = p;
  }
  for (int k = 0; k < 3; ++k) {
    low[k] = (double)lowest[k];
    high[k] = (double)highest[k];
  }
}

/* A pose with a handle at the lowest and one at the highest corner. Returns the distance of both along y. */
static double mesh_pose(const Mesh* mesh, hf_surface surface, hf_pose* pose, uint32_t* low_handle,
                        uint32_t* high_handle) {
  double low[3], high[3];
  mesh_ends(mesh, low, high);
  const double size = high[1] - low[1];
  ok(hf_pose_create(surface, NULL, pose));
  ok(hf_pose_add_handle_at(*pose, low, 0.15 * size, low_handle));
  ok(hf_pose_add_handle_at(*pose, high, 0.15 * size, high_handle));
  return size;
}

#endif
