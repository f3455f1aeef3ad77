/// Writes triangles as a PDF by gl2ps, whose BSP tree sorts them back to front.
///
///   peer_gl2ps TRIANGLES OUT.pdf
///
/// A line of TRIANGLES is nine coordinates in pixels, the third of each point
/// its depth, greater is nearer, three channels from 0 to 255, and 1 if it is
/// of a closed surface, else 0. The image is 1000 x 1000. Prints seconds of
/// processor time. Not a part of the library.
#include <GL/gl.h>
#include <GL/osmesa.h>
#include <gl2ps.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

namespace {

constexpr int kSide = 1000;
using Triangle = std::array<float, 13>;

std::vector<Triangle> read_triangles(const char* path) {
  std::vector<Triangle> triangles;
  std::FILE* file = std::fopen(path, "r");
  if (file == nullptr) return triangles;
  for (;;) {
    Triangle t;
    bool complete = true;
    for (float& number : t)
      complete = complete && std::fscanf(file, "%f", &number) == 1;
    if (!complete) break;
    triangles.push_back(t);
  }
  std::fclose(file);
  return triangles;
}

void draw(const std::vector<Triangle>& triangles) {
  glBegin(GL_TRIANGLES);
  for (const Triangle& t : triangles) {
    glColor3f(t[9] / 255, t[10] / 255, t[11] / 255);
    for (int k = 0; k < 3; ++k)
      glVertex3f(t[3 * k], t[3 * k + 1], t[3 * k + 2]);
  }
  glEnd();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const std::vector<Triangle> triangles = read_triangles(argv[1]);
  std::vector<unsigned char> pixels(4 * kSide * kSide);
  const OSMesaContext context =
      OSMesaCreateContextExt(GL_RGBA, 24, 0, 0, nullptr);
  if (context == nullptr || !OSMesaMakeCurrent(context, pixels.data(),
                                               GL_UNSIGNED_BYTE, kSide, kSide))
    return 1;
  glViewport(0, 0, kSide, kSide);
  glMatrixMode(GL_PROJECTION);
  glLoadIdentity();
  glOrtho(0, kSide, kSide, 0, -2 * kSide, 2 * kSide);
  glEnable(GL_DEPTH_TEST);
  std::FILE* out = std::fopen(argv[2], "wb");
  if (out == nullptr) return 1;
  const std::clock_t start = std::clock();
  GLint viewport[4] = {0, 0, kSide, kSide};
  for (GLint size = 1 << 22;; size *= 2) {
    std::rewind(out);
    gl2psBeginPage("scene", "bench", viewport, GL2PS_PDF, GL2PS_BSP_SORT,
                   GL2PS_SILENT | GL2PS_NO_BLENDING | GL2PS_BEST_ROOT |
                       GL2PS_OCCLUSION_CULL,
                   GL_RGBA, 0, nullptr, 0, 0, 0, size, out, "scene");
    draw(triangles);
    if (gl2psEndPage() != GL2PS_OVERFLOW) break;
  }
  std::printf("%.3f\n",
              static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  std::fclose(out);
  OSMesaDestroyContext(context);
  return 0;
}
