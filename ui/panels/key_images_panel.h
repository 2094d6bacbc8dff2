#pragma once

#include <QLabel>
#include <QTreeWidget>

#include "ui/controller/derived_objects.h"
#include "ui/data/picture_index.h"
#include "ui/workspace/key_image_list.h"
#include "ui/workspace/session.h"

class QAction;

namespace volumen {

/// Where the pictures of all that is open are: StudiesPanel::allPictures().
using OpenPictures = std::function<std::vector<const Series*>()>;

/// The key images: those that the user marked and those of the key object documents that are open. A click
/// goes to one.
class KeyImagesPanel : public QWidget {
  Q_OBJECT
 public:
  /// `actions` become its buttons.
  KeyImagesPanel(Session& session, DerivedObjects& derived, OpenPictures pictures,
                 const QList<QAction*>& actions, QWidget* parent = nullptr);

  /// The one after a picture (step 1) or before it (-1) in the list, from its other end on; the first, or the
  /// last, where it is none of them. None: there are none.
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
