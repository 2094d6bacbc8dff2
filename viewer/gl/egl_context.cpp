#define EGL_NO_X11
#include <dlfcn.h>
#include <epoxy/egl.h>

#include <string_view>
#include <vector>

#include "viewer/gl/gl_context.h"

namespace volumen {

namespace {

// libepoxy ends the program if a library is missing, so libraries are looked for first.
bool canLoad(const char* library) {
  void* handle = dlopen(library, RTLD_LAZY | RTLD_LOCAL);
  if (handle) dlclose(handle);
  return handle != nullptr;
}

bool lists(const char* extensions, std::string_view wanted) {
  const std::string_view all = extensions ? extensions : "";
  for (std::size_t at = all.find(wanted); at != std::string_view::npos; at = all.find(wanted, at + 1)) {
    const std::size_t end = at + wanted.size();
    if ((at == 0 || all[at - 1] == ' ') && (end == all.size() || all[end] == ' ')) return true;
  }
  return false;
}

class EglContext : public GlContext {
 public:
  EglContext(EGLDisplay display, EGLContext context) : display_(display), context_(context) {}
  // The display belongs to the process and all contexts share it. Ending it would end them too.
  ~EglContext() override { eglDestroyContext(display_, context_); }
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  bool makeCurrent() override {
    // The API in which a context is looked up is a setting of the calling thread.
    return eglBindAPI(EGL_OPENGL_API) &&
           eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_TRUE;
  }
  void doneCurrent() override {
    eglBindAPI(EGL_OPENGL_API);
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }

 private:
  EGLDisplay display_;
  EGLContext context_;
};

// Returns a context of OpenGL 3.3 core that needs no surface; null if the display has none.
std::unique_ptr<GlContext> contextOf(EGLDisplay display) {
  if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr)) return nullptr;
  const char* extensions = eglQueryString(display, EGL_EXTENSIONS);
  if (!lists(extensions, "EGL_KHR_surfaceless_context") || !lists(extensions, "EGL_KHR_create_context"))
    return nullptr;
  if (!eglBindAPI(EGL_OPENGL_API)) return nullptr;
  const EGLint wanted[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (!eglChooseConfig(display, wanted, &config, 1, &count) || count == 0) return nullptr;
  const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION_KHR,
                               3,
                               EGL_CONTEXT_MINOR_VERSION_KHR,
                               3,
                               EGL_CONTEXT_OPENGL_PROFILE_MASK_KHR,
                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT_KHR,
                               EGL_NONE};
  EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, attributes);
  if (context == EGL_NO_CONTEXT) return nullptr;
  auto made = std::make_unique<EglContext>(display, context);
  return CurrentContext(*made) ? std::move(made) : nullptr;
}

std::unique_ptr<GlContext> contextOfDevices() {
  EGLDeviceEXT devices[16];
  EGLint count = 0;
  if (!eglQueryDevicesEXT(16, devices, &count)) return nullptr;
  for (int n = 0; n < count; ++n)
    if (auto made = contextOf(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[n], nullptr)))
      return made;
  return nullptr;
}

}  // namespace

Result<std::unique_ptr<GlContext>> makeEglContext() {
  if (!canLoad("libOpenGL.so.0") && !canLoad("libGL.so.1")) return Error{"there is no libOpenGL"};
  if (!epoxy_has_egl()) return Error{"there is no libEGL"};
  const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (!lists(extensions, "EGL_EXT_platform_base")) return Error{"this EGL needs a display"};
  std::unique_ptr<GlContext> made;
  if (lists(extensions, "EGL_MESA_platform_surfaceless"))
    made = contextOf(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
  const bool devices =
      lists(extensions, "EGL_EXT_platform_device") &&
      (lists(extensions, "EGL_EXT_device_base") || lists(extensions, "EGL_EXT_device_enumeration"));
  if (!made && devices) made = contextOfDevices();
  if (!made) return Error{"no EGL driver here has OpenGL 3.3 without a display"};
  return made;
}

}  // namespace volumen
