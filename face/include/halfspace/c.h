#ifndef HALFSPACE_C_H
#define HALFSPACE_C_H

/* The core of the library for other languages: solids as handles. Handles are
 * never null, and each is given back by its free function. A function that asks
 * returns 0, or the error's code plus 1, and then fills in `error`, which may
 * be null. Solids may be used in any threads at once; a mesh in one at a time.
 */

#include <stddef.h>
#include <stdint.h>

#include "halfspace/api.hpp"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct halfspace_solid halfspace_solid;
typedef struct halfspace_mesh halfspace_mesh;

/* The message ends with a zero, and is cut off where it is longer. */
typedef struct halfspace_error {
  int32_t code;
  int64_t index;
  char message[512];
} halfspace_error;

HALFSPACE_API const char* halfspace_version(void);

/* Making cannot fail: what is wrong comes out where the solid is used. */
HALFSPACE_API halfspace_solid* halfspace_box(const double corner[3],
                                             const double opposite[3]);
HALFSPACE_API halfspace_solid* halfspace_sphere(double radius, int segments);
HALFSPACE_API halfspace_solid* halfspace_cylinder(double radius, double height,
                                                  int segments);
/* Three doubles a vertex; the corners of polygon p are those from
 * first_corner[p] to before first_corner[p + 1]. Everything is copied. */
HALFSPACE_API halfspace_solid* halfspace_from_mesh(const double* vertices,
                                                   size_t vertex_count,
                                                   const uint32_t* first_corner,
                                                   size_t polygon_count,
                                                   const int32_t* corners);
HALFSPACE_API halfspace_solid* halfspace_from_file(const char* path);
HALFSPACE_API halfspace_solid* halfspace_from_text(const char* script);
/* The operation is one of + - & ^ ; another one gives the empty solid. */
HALFSPACE_API halfspace_solid* halfspace_combine(char operation,
                                                 const halfspace_solid* a,
                                                 const halfspace_solid* b);
/* Three rows of four numbers: (x, y, z) goes to rows . (x, y, z, 1). */
HALFSPACE_API halfspace_solid* halfspace_transform(const halfspace_solid* solid,
                                                   const double rows[12]);
HALFSPACE_API void halfspace_free_solid(halfspace_solid* solid);

HALFSPACE_API int halfspace_volume(const halfspace_solid* solid, double* volume,
                                   halfspace_error* error);
/* -1 inside, 0 on the surface, 1 outside. */
HALFSPACE_API int halfspace_locate(const halfspace_solid* solid,
                                   const double point[3], int* side,
                                   halfspace_error* error);
HALFSPACE_API int halfspace_save(const halfspace_solid* solid, const char* path,
                                 halfspace_error* error);

/* The surface as triangles; `mesh` is to be freed if the answer is 0. */
HALFSPACE_API int halfspace_to_mesh(const halfspace_solid* solid,
                                    halfspace_mesh** mesh,
                                    halfspace_error* error);
HALFSPACE_API size_t halfspace_vertex_count(const halfspace_mesh* mesh);
HALFSPACE_API size_t halfspace_triangle_count(const halfspace_mesh* mesh);
/* Three doubles a vertex, three corners a triangle, and an operand and a
 * polygon of it a triangle; valid as long as the mesh is. */
HALFSPACE_API const double* halfspace_vertices(const halfspace_mesh* mesh);
HALFSPACE_API const int32_t* halfspace_triangles(const halfspace_mesh* mesh);
HALFSPACE_API const int32_t* halfspace_origins(const halfspace_mesh* mesh);
HALFSPACE_API void halfspace_free_mesh(halfspace_mesh* mesh);

#ifdef __cplusplus
}
#endif

#endif
