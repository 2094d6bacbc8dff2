#pragma once

#include <QMenu>
#include <stdexcept>

namespace volumen {

/// An action or menu that one feature makes and sets, and that others use. Throws std::logic_error if it is
/// used before it is set, so that a window whose features are made in a wrong order does not start.
template <class T>
class Handle {
 public:
  void operator=(T* made) { made_ = made; }
  operator T*() const {
    if (!made_) throw std::logic_error("a feature uses an action that no feature before it has made");
    return made_;
  }

 private:
  T* made_ = nullptr;
};

/// The actions and menus that more than one feature uses.
struct SharedActions {
  Handle<QAction> openFolder, openFile, openSample;
  Handle<QAction> commands;
  Handle<QMenu> overlays;
};

}  // namespace volumen
