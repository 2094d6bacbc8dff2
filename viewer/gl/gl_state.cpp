#include "viewer/gl/gl_state.h"

#include <epoxy/gl.h>

namespace volumen {

namespace {

Error noOpenGl(const std::string& why) {
  return Error{"No OpenGL could be had: " + why + "; use --resampler cpu."};
}

}  // namespace

Result<std::unique_ptr<GlState>> makeGlState(const GlContextFactory& factory) {
  auto context = factory();
  if (!context) return noOpenGl(context.message());
  const CurrentContext current(**context);
  if (!current) return noOpenGl("its context cannot be made current");
  if (!epoxy_is_desktop_gl() || epoxy_gl_version() < 33) return noOpenGl("it is older than 3.3");
  auto state = std::make_unique<GlState>();
  if (const GLubyte* name = glGetString(GL_RENDERER)) state->renderer = reinterpret_cast<const char*>(name);
  state->context = std::move(*context);
  return state;
}

}  // namespace volumen
