#include "viewer/gl/program.h"

#include <epoxy/gl.h>

namespace volumen {

namespace {

Result<GLuint> compile(GLenum kind, const std::string& defines, const std::vector<const char*>& parts) {
  // `precise` (if the driver has it) keeps the compiler from fusing a multiply and an add, as the CPU kernels
  // do not fuse them.
  const std::string head =
      "#version 330 core\n"
      "#extension GL_ARB_gpu_shader5 : enable\n"
      "#ifdef GL_ARB_gpu_shader5\n#define EXACT precise\n#else\n#define EXACT\n#endif\n" +
      defines;
  std::vector<const char*> texts{head.c_str()};
  texts.insert(texts.end(), parts.begin(), parts.end());
  const GLuint shader = glCreateShader(kind);
  glShaderSource(shader, GLsizei(texts.size()), texts.data(), nullptr);
  glCompileShader(shader);
  GLint compiled = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled) return shader;
  char log[512] = {};
  glGetShaderInfoLog(shader, sizeof log, nullptr, log);
  glDeleteShader(shader);
  return Error{std::string("OpenGL refused a shader: ") + log + "; use --resampler cpu."};
}

Result<GLuint> link(const std::string& defines, const char* vertexText,
                    const std::vector<const char*>& fragmentTexts) {
  const auto vertex = compile(GL_VERTEX_SHADER, defines, {vertexText});
  if (!vertex) return vertex;
  const auto fragment = compile(GL_FRAGMENT_SHADER, defines, fragmentTexts);
  if (!fragment) return fragment;
  const GLuint program = glCreateProgram();
  for (GLuint shader : {*vertex, *fragment}) {
    glAttachShader(program, shader);
    glDeleteShader(shader);
  }
  glLinkProgram(program);
  GLint linked = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked) return program;
  glDeleteProgram(program);
  return Error{"OpenGL could not link its shaders; use --resampler cpu."};
}

}  // namespace

Result<unsigned> Programs::of(const std::string& defines, const char* vertexText,
                              const std::vector<const char*>& fragmentTexts) {
  const auto known = made_.find(defines);
  if (known != made_.end()) return known->second;
  const auto program = link(defines, vertexText, fragmentTexts);
  if (program) made_[defines] = *program;
  return program;
}

void bindTexture(int unit, unsigned kind, unsigned texture) {
  glActiveTexture(GLenum(GL_TEXTURE0 + unit));
  glBindTexture(kind, texture);
}

Status BufferTexture::uploadBytes(unsigned format, std::size_t texels, const void* data, std::size_t bytes) {
  GLint most = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most);
  if (texels > std::size_t(most))
    return Error{"OpenGL here takes tables of at most " + std::to_string(most) +
                 " entries, too few for this picture; use --resampler cpu."};
  if (!buffer_) {
    glGenBuffers(1, &buffer_);
    glGenTextures(1, &texture_);
  }
  glBindBuffer(GL_TEXTURE_BUFFER, buffer_);
  glBufferData(GL_TEXTURE_BUFFER, GLsizeiptr(bytes), data, GL_STREAM_DRAW);
  glBindTexture(GL_TEXTURE_BUFFER, texture_);
  glTexBuffer(GL_TEXTURE_BUFFER, format, buffer_);
  glBindBuffer(GL_TEXTURE_BUFFER, 0);
  return {};
}

void BufferTexture::bind(int unit) const { bindTexture(unit, GL_TEXTURE_BUFFER, texture_); }

}  // namespace volumen
