#pragma once

#include "ui/widgets/bind.h"
#include "ui/workspace/session.h"

namespace volumen {

/// The reflection of surfaces. Disabled if the scene is unlit.
class MaterialPanel : public QWidget {
  Q_OBJECT
 public:
  explicit MaterialPanel(Session& session, QWidget* parent = nullptr);

 private:
  Bindings bindings_;
};

}  // namespace volumen
