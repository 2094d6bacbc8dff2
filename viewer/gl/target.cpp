#include "viewer/gl/target.h"

#include <epoxy/gl.h>

#include <algorithm>

namespace volumen {

namespace {

// Returns true if the bound framebuffer can be drawn into.
bool complete() {
  return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE && glGetError() == GL_NO_ERROR;
}

GLuint attach(GLenum attachment, GLenum format, glm::ivec2 size) {
  const GLuint texture = makePlainTexture(format, size);
  glFramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D, texture, 0);
  return texture;
}

GLintptr bytesOf(int width, int rows) { return GLintptr(rows) * width * GLintptr(sizeof(float)); }

}  // namespace

void clearGlErrors() {
  while (glGetError() != GL_NO_ERROR) {
  }
}

unsigned makePlainTexture(unsigned format, glm::ivec2 size) {
  GLuint name = 0;
  glGenTextures(1, &name);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, name);
  glTexImage2D(GL_TEXTURE_2D, 0, GLint(format), size.x, size.y, 0, GL_RGBA, GL_FLOAT, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
  return name;
}

bool PictureTarget::make(unsigned format, glm::ivec2 size) {
  clearGlErrors();
  if (!framebuffer_) glGenFramebuffers(1, &framebuffer_);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glDeleteTextures(1, &texture_);
  texture_ = attach(GL_COLOR_ATTACHMENT0, format, size);
  const bool made = complete();
  size_ = made ? size : glm::ivec2(0);
  return made;
}

void PictureTarget::use() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glViewport(0, 0, size_.x, size_.y);
}

const std::vector<float>& PictureTarget::pixels() {
  pixels_.resize(std::size_t(4) * size_.x * size_.y);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  glReadPixels(0, 0, size_.x, size_.y, GL_RGBA, GL_FLOAT, pixels_.data());
  if (glGetError() != GL_NO_ERROR) pixels_.clear();
  return pixels_;
}

bool SampleTarget::make(glm::ivec2 size, bool gradients) {
  clearGlErrors();
  size_ = size;
  glGenFramebuffers(1, &framebuffer_);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  density_ = attach(GL_COLOR_ATTACHMENT0, GL_R32F, size);
  if (gradients) gradients_ = attach(GL_COLOR_ATTACHMENT1, GL_RGBA32F, size);
  const GLenum both[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  glDrawBuffers(gradients ? 2 : 1, both);
  glGenBuffers(1, &buffer_);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, buffer_);
  glBufferData(GL_PIXEL_PACK_BUFFER, bytesOf(size.x, size.y) * (gradients ? 5 : 1), nullptr, GL_STREAM_READ);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  return complete();
}

void SampleTarget::free() {
  glDeleteFramebuffers(1, &framebuffer_);
  glDeleteTextures(1, &density_);
  glDeleteTextures(1, &gradients_);
  glDeleteBuffers(1, &buffer_);
  *this = {};
}

void SampleTarget::use() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glViewport(0, 0, size_.x, size_.y);
}

void SampleTarget::startReading(int rows) {
  rows_ = rows;
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, buffer_);
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  glReadPixels(0, 0, size_.x, rows, GL_RED, GL_FLOAT, nullptr);
  if (gradients_) {
    glReadBuffer(GL_COLOR_ATTACHMENT1);
    glReadPixels(0, 0, size_.x, rows, GL_RGBA, GL_FLOAT, reinterpret_cast<void*>(bytesOf(size_.x, rows)));
  }
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  glFlush();
}

SampleTarget::Samples SampleTarget::map() {
  // Rays that miss the volume have no samples, but no buffer can be mapped with 0 bytes.
  const GLintptr density = bytesOf(size_.x, std::max(rows_, 1)), all = density * (gradients_ ? 5 : 1);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, buffer_);
  const auto* data =
      static_cast<const char*>(glMapBufferRange(GL_PIXEL_PACK_BUFFER, 0, all, GL_MAP_READ_BIT));
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  if (!data || glGetError() != GL_NO_ERROR) return {};
  return {reinterpret_cast<const float*>(data),
          gradients_ ? reinterpret_cast<const float*>(data + density) : nullptr};
}

void SampleTarget::unmap() {
  glBindBuffer(GL_PIXEL_PACK_BUFFER, buffer_);
  glUnmapBuffer(GL_PIXEL_PACK_BUFFER);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
}

}  // namespace volumen
