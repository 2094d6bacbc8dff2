#include "ui/main_window.h"
#include "viewer/scene/presets.h"

namespace volumen {

Services realServices() { return {drawWithCaches, presetScene, presetNames()}; }

}  // namespace volumen
