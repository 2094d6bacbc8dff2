#pragma once

#include "ui/session/session.h"
#include "ui/widgets/bind.h"

namespace volumen {

/// How surfaces answer the lights; greyed where the scene is unlit.
class MaterialPanel : public QWidget {
  Q_OBJECT
 public:
  explicit MaterialPanel(Session& session, QWidget* parent = nullptr);

 private:
  Bindings bindings_;
};

}  // namespace volumen
