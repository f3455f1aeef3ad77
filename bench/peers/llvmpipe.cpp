#define GL_GLEXT_PROTOTYPES 1
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/gl.h>
#include <GL/glext.h>

#include <cstddef>
#include <cstdlib>
#include <string_view>

#include "peers/peer.hpp"
#include "peers/shared_vertices.hpp"

namespace halfspace::bench {
namespace {

constexpr const char* kFlatVertex = R"(#version 330 core
uniform mat4 clip;
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 color;
flat out vec4 shade;
void main() {
  gl_Position = clip * vec4(position, 1);
  shade = color;
}
)";

constexpr const char* kFlatFragment = R"(#version 330 core
flat in vec4 shade;
out vec4 pixel;
void main() { pixel = shade; }
)";

constexpr const char* kSmoothVertex = R"(#version 330 core
uniform mat4 clip;
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 color;
out vec4 shade;
void main() {
  gl_Position = clip * vec4(position, 1);
  shade = color;
}
)";

constexpr const char* kSmoothFragment = R"(#version 330 core
in vec4 shade;
out vec4 pixel;
void main() { pixel = shade; }
)";

/// A context without a window that draws in software, in this thread, or an
/// empty handle.
struct Context {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
};

/// Why there is no context; empty if there is.
std::string open(Context& opened) {
  // Mesa reads these when the display opens.
  setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
  setenv("GALLIUM_DRIVER", "llvmpipe", 1);
  setenv("LP_NUM_THREADS", "0", 1);
  opened.display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA,
                                         EGL_DEFAULT_DISPLAY, nullptr);
  if (opened.display == EGL_NO_DISPLAY) return "no surfaceless EGL display";
  if (!eglInitialize(opened.display, nullptr, nullptr)) {
    return "EGL does not start";
  }
  if (!eglBindAPI(EGL_OPENGL_API)) return "EGL has no OpenGL";
  const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                               3,
                               EGL_CONTEXT_MINOR_VERSION,
                               3,
                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                               EGL_NONE};
  opened.context = eglCreateContext(opened.display, EGL_NO_CONFIG_KHR,
                                    EGL_NO_CONTEXT, attributes);
  if (opened.context == EGL_NO_CONTEXT) return "EGL has no OpenGL 3.3";
  if (!eglMakeCurrent(opened.display, EGL_NO_SURFACE, EGL_NO_SURFACE,
                      opened.context)) {
    return "EGL cannot draw without a surface";
  }
  const auto* const renderer =
      reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  if (renderer == nullptr ||
      std::string_view(renderer).find("llvmpipe") == std::string_view::npos) {
    return std::string("OpenGL is drawn by ") +
           (renderer == nullptr ? "nobody" : renderer) + ", not by llvmpipe";
  }
  return {};
}

GLuint compiled(GLenum kind, const char* text) {
  const GLuint shader = glCreateShader(kind);
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  return shader;
}

/// A program; 0 if it does not link.
GLuint linked(const char* vertex, const char* fragment) {
  const GLuint program = glCreateProgram();
  glAttachShader(program, compiled(GL_VERTEX_SHADER, vertex));
  glAttachShader(program, compiled(GL_FRAGMENT_SHADER, fragment));
  glLinkProgram(program);
  GLint good = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &good);
  return good ? program : 0;
}

/// Triangles uploaded: a vertex array for colours and one for ids.
struct Uploaded {
  GLuint colors = 0;
  GLuint ids = 0;
  GLsizei count = 0;
};

GLuint vertex_array(GLuint vertices, GLuint indices, std::size_t color_offset) {
  GLuint array = 0;
  glGenVertexArrays(1, &array);
  glBindVertexArray(array);
  glBindBuffer(GL_ARRAY_BUFFER, vertices);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices);
  glEnableVertexAttribArray(0);
  glEnableVertexAttribArray(1);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(SharedVertex),
                        nullptr);
  glVertexAttribPointer(1, 4, GL_UNSIGNED_BYTE, GL_TRUE, sizeof(SharedVertex),
                        reinterpret_cast<const void*>(color_offset));
  return array;
}

Uploaded upload(const SharedVertices& shared) {
  GLuint buffers[2] = {};
  glGenBuffers(2, buffers);
  glBindVertexArray(0);
  glBindBuffer(GL_ARRAY_BUFFER, buffers[0]);
  glBufferData(
      GL_ARRAY_BUFFER,
      static_cast<GLsizeiptr>(shared.vertices.size() * sizeof(SharedVertex)),
      shared.vertices.data(), GL_STATIC_DRAW);
  glBindBuffer(GL_COPY_WRITE_BUFFER, buffers[1]);
  glBufferData(GL_COPY_WRITE_BUFFER,
               static_cast<GLsizeiptr>(shared.indices.size() * 4),
               shared.indices.data(), GL_STATIC_DRAW);
  return {vertex_array(buffers[0], buffers[1], offsetof(SharedVertex, color)),
          vertex_array(buffers[0], buffers[1], offsetof(SharedVertex, id)),
          static_cast<GLsizei>(shared.indices.size())};
}

class Llvmpipe final : public Peer {
 public:
  ~Llvmpipe() override {
    if (context_.display == EGL_NO_DISPLAY) return;
    eglMakeCurrent(context_.display, EGL_NO_SURFACE, EGL_NO_SURFACE,
                   EGL_NO_CONTEXT);
    if (context_.context != EGL_NO_CONTEXT) {
      eglDestroyContext(context_.display, context_.context);
    }
  }

  /// Why it does not work; empty if it does.
  std::string set_up(const Soup& soup, const std::vector<std::uint32_t>& order,
                     bool depth_test) {
    width_px_ = soup.width_px;
    height_px_ = soup.height_px;
    if (std::string why = open(context_); !why.empty()) return why;
    flat_program_ = linked(kFlatVertex, kFlatFragment);
    smooth_program_ = linked(kSmoothVertex, kSmoothFragment);
    if (flat_program_ == 0 || smooth_program_ == 0) {
      return "the shaders do not link";
    }
    depth_test_ = depth_test;
    set_target();
    for (const GLuint program : {flat_program_, smooth_program_}) {
      set_clip(soup, program);
    }
    flat_ = upload(shared_for_flat(soup, order));
    smooth_ = upload(shared_for_smooth(soup, order));
    glViewport(0, 0, width_px_, height_px_);
    glClearColor(1, 1, 1, 1);
    glDisable(GL_DITHER);
    if (depth_test) {
      glEnable(GL_DEPTH_TEST);
      glDepthFunc(GL_LESS);
    }
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE ||
        glGetError() != GL_NO_ERROR) {
      return "OpenGL reports an error";
    }
    return {};
  }

  void draw(Look look) override {
    // Several of these may be alive, each with a context of its own.
    eglMakeCurrent(context_.display, EGL_NO_SURFACE, EGL_NO_SURFACE,
                   context_.context);
    glClear(depth_test_ ? GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT
                        : GL_COLOR_BUFFER_BIT);
    const bool smooth = look == Look::kSmooth;
    const Uploaded& triangles = smooth ? smooth_ : flat_;
    glUseProgram(smooth ? smooth_program_ : flat_program_);
    glBindVertexArray(look == Look::kIds ? triangles.ids : triangles.colors);
    glDrawElements(GL_TRIANGLES, triangles.count, GL_UNSIGNED_INT, nullptr);
    glFinish();
  }

  std::vector<Pixel> pixels() override {
    eglMakeCurrent(context_.display, EGL_NO_SURFACE, EGL_NO_SURFACE,
                   context_.context);
    std::vector<Pixel> frame(static_cast<std::size_t>(width_px_) *
                             static_cast<std::size_t>(height_px_));
    glReadPixels(0, 0, width_px_, height_px_, GL_RGBA, GL_UNSIGNED_BYTE,
                 frame.data());
    return frame;
  }

 private:
  void set_target() {
    GLuint frame_buffer = 0;
    GLuint buffers[2] = {};
    glGenFramebuffers(1, &frame_buffer);
    glGenRenderbuffers(2, buffers);
    glBindFramebuffer(GL_FRAMEBUFFER, frame_buffer);
    glBindRenderbuffer(GL_RENDERBUFFER, buffers[0]);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width_px_, height_px_);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0,
                              GL_RENDERBUFFER, buffers[0]);
    // Where no depth is attached, llvmpipe forgets what a tile held as soon as
    // a triangle covers all of it.
    if (!depth_test_) return;
    glBindRenderbuffer(GL_RENDERBUFFER, buffers[1]);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, width_px_,
                          height_px_);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT,
                              GL_RENDERBUFFER, buffers[1]);
  }

  /// Image points to clip space: x from 0 to the width becomes -w to w, and
  /// the image's first row becomes OpenGL's, so that it is read first.
  void set_clip(const Soup& soup, GLuint program) const {
    float clip[16] = {};
    const double near = soup.near, far = soup.far;
    for (std::size_t column = 0; column < 4; ++column) {
      const double x = soup.to_image[0][column];
      const double y = soup.to_image[1][column];
      const double w = soup.to_image[2][column];
      const double one = column == 3 ? 1 : 0;
      float* const out = clip + 4 * column;
      out[0] = static_cast<float>(2 * x / soup.width_px - w);
      out[1] = static_cast<float>(2 * y / soup.height_px - w);
      out[2] = static_cast<float>(((far + near) * w - 2 * far * near * one) /
                                  (far - near));
      out[3] = static_cast<float>(w);
    }
    glUseProgram(program);
    glUniformMatrix4fv(glGetUniformLocation(program, "clip"), 1, GL_FALSE,
                       clip);
  }

  Context context_;
  std::int32_t width_px_ = 0;
  std::int32_t height_px_ = 0;
  bool depth_test_ = true;
  GLuint flat_program_ = 0;
  GLuint smooth_program_ = 0;
  Uploaded flat_;
  Uploaded smooth_;
};

}  // namespace

std::unique_ptr<Peer> make_llvmpipe(const Soup& soup,
                                    const std::vector<std::uint32_t>& order,
                                    bool depth_test, std::string& why) {
  auto peer = std::make_unique<Llvmpipe>();
  why = peer->set_up(soup, order, depth_test);
  if (!why.empty()) return nullptr;
  return peer;
}

}  // namespace halfspace::bench
