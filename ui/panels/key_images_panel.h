#pragma once

#include <QLabel>
#include <QTreeWidget>

#include "ui/controller/derived_objects.h"
#include "ui/data/picture_index.h"
#include "ui/workspace/key_image_list.h"
#include "ui/workspace/session.h"

class QAction;

namespace volumen {

/// Returns the pictures of all open studies: StudiesPanel::allPictures().
using OpenPictures = std::function<std::vector<const Series*>()>;

/// The key images of the user and of open key object documents. A click shows one.
class KeyImagesPanel : public QWidget {
  Q_OBJECT
 public:
  /// `actions` become buttons of the panel.
  KeyImagesPanel(Session& session, DerivedObjects& derived, OpenPictures pictures,
                 const QList<QAction*>& actions, QWidget* parent = nullptr);

  /// Returns the key image after (`step` 1) or before (-1) a picture in the list, wrapping around. Returns
  /// the first or last if the picture is no key image, and nothing if the list is empty.
  std::optional<PicturePlace> next(const SeriesKey& series, int index, int step) const;

 Q_SIGNALS:
  void pictureChosen(const volumen::Series& series, int index);

 private:
  std::vector<KeyImageGroup> groups() const;
  void showAll();
  void addPicture(QTreeWidgetItem* parent, const ListedKeyImage& picture);
  void addNotHere(QTreeWidgetItem* parent, std::size_t notHere);

  Session& session_;
  DerivedObjects& derived_;
  const OpenPictures pictures_;
  QLabel* empty_;
  QTreeWidget* list_;
  std::vector<ListedKeyImage> entries_;
};

}  // namespace volumen
