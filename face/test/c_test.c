/* The interface for other languages, used from C. */
#include "halfspace/c.h"

#include <stdio.h>
#include <string.h>

#define CHECK(condition)                                \
  do {                                                  \
    if (!(condition)) {                                 \
      printf("%d: not so: %s\n", __LINE__, #condition); \
      return 1;                                         \
    }                                                   \
  } while (0)

int main(void) {
  const double low[3] = {0, 0, 0}, high[3] = {1, 1, 1},
               half[3] = {0.5, 0.5, 0.5};
  const double move[12] = {1, 0, 0, 0.5, 0, 1, 0, 0.5, 0, 0, 1, 0.5};
  halfspace_solid* cube = halfspace_box(low, high);
  halfspace_solid* moved = halfspace_transform(cube, move);
  halfspace_solid* part = halfspace_combine('-', cube, moved);
  halfspace_solid* none = halfspace_from_file("no.off");
  halfspace_solid* again;
  halfspace_mesh* mesh = NULL;
  halfspace_error error;
  double volume = 0;
  int side = 9;
  CHECK(strcmp(halfspace_version(), "0.1.0") == 0);
  CHECK(halfspace_volume(part, &volume, &error) == 0 && volume == 0.875);
  CHECK(halfspace_locate(part, half, &side, NULL) == 0 && side == 0);
  CHECK(halfspace_locate(part, high, &side, NULL) == 0 && side == 1);
  CHECK(halfspace_to_mesh(part, &mesh, &error) == 0);
  CHECK(halfspace_vertex_count(mesh) == 14);
  CHECK(halfspace_triangle_count(mesh) == 24);
  {
    uint32_t first[25];
    uint32_t p;
    for (p = 0; p < 25; ++p) first[p] = 3 * p;
    again = halfspace_from_mesh(halfspace_vertices(mesh), 14, first, 24,
                                halfspace_triangles(mesh));
  }
  CHECK(halfspace_origins(mesh)[0] >= 0);
  CHECK(halfspace_volume(again, &volume, NULL) == 0 && volume == 0.875);
  CHECK(halfspace_volume(none, &volume, &error) == error.code + 1);
  CHECK(strstr(error.message, "no.off") != NULL);
  halfspace_free_mesh(mesh);
  halfspace_free_solid(again);
  halfspace_free_solid(none);
  halfspace_free_solid(part);
  halfspace_free_solid(moved);
  halfspace_free_solid(cube);
  return 0;
}
