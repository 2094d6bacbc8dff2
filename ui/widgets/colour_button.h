#pragma once

#include <QColorDialog>
#include <QPointer>
#include <QToolButton>
#include <glm/vec3.hpp>

namespace volumen {

/// Opens a non-modal colour chooser beside `owner`. It calls `picked` while the user tries colours, and
/// `finished` when the chooser is closed.
void chooseColour(QWidget* owner, const QString& title, glm::dvec3 start,
                  const std::function<void(glm::dvec3)>& picked, const std::function<void()>& finished);

/// A colour swatch; a click opens the chooser.
class ColourButton : public QToolButton {
  Q_OBJECT
 public:
  /// `title` is the chooser's title and the accessible name.
  explicit ColourButton(const QString& title, QWidget* parent = nullptr);

  void setColour(glm::dvec3 colour);
  glm::dvec3 colour() const { return colour_; }

 Q_SIGNALS:
  void colourEdited(glm::dvec3 colour);
  void gestureFinished();

 protected:
  void paintEvent(QPaintEvent*) override;

 private:
  glm::dvec3 colour_{1};
};

}  // namespace volumen
