#pragma once

#include <QObject>
#include <QStringList>
#include <memory>
#include <vector>

#include "io/study/series_key.h"
#include "io/study/study.h"
#include "ui/data/derived_key.h"
#include "ui/workspace/workspace.h"

namespace volumen {

/// The content of an opened path: volumes, and frames of series that are no volumes.
struct OpenStudy {
  QString path;
  std::shared_ptr<const Study> study;
  std::vector<Series> frames;

  /// Returns the n-th series, volumes before frames; null beyond the last.
  const Series* seriesAt(std::size_t n) const;
  /// Returns the index of a volume of `study`.
  std::size_t numberOf(const Series& volume) const { return std::size_t(&volume - study->volumes.data()); }
  /// Returns indices in rows: the time points of one series together, in their order.
  std::vector<std::vector<std::size_t>> rows() const;
};

/// The open studies, in the order of opening. Items removed from the list stay known, so that undo brings
/// them back.
class OpenStudies : public QObject {
  Q_OBJECT
 public:
  using QObject::QObject;

  /// Adds the content of a path and replaces its earlier content.
  void add(const QString& path, const std::shared_ptr<const Study>& study);
  /// Sets which items are not in the list.
  void setUnlisted(const Unlisted& unlisted);
  /// Forgets paths without content to list.
  void forgetEmpty();

  const std::vector<OpenStudy>& all() const { return all_; }
  /// Returns the study of a path, or null if it is unknown.
  const OpenStudy* find(const QString& path) const;
  /// Returns the study of a path, or null if nothing of it is in the list.
  std::shared_ptr<const Study> studyOf(const QString& path) const;

  bool isListed(const Series& series) const { return !unlisted_.series.contains(keyOf(series)); }
  bool isListed(const DerivedObject& object) const { return !unlisted_.derived.contains(keyOf(object)); }
  /// Returns whether any item of it is listed, or there is nothing to list.
  bool isListed(const OpenStudy& opened) const;

  /// Returns all volumes in the list.
  std::vector<const Series*> volumes() const;
  /// Returns all volumes in the list, then the frames of series that are no volumes.
  std::vector<const Series*> pictures() const;
  /// Returns all listed objects that refer to pictures.
  std::vector<DerivedObjectPtr> derived() const;
  /// Returns files that hold neither pixels nor derived objects, each with its kind: "F: DICOM file without
  /// pixel data (CR)".
  QStringList filesWithoutPixels() const;
  /// Returns all items that could be listed.
  Unlisted everything() const;

 Q_SIGNALS:
  /// The content of this path was replaced or added.
  void added(const QString& path);
  /// setUnlisted() changed the list. `comesBack`: some items are listed again.
  void unlistedChanged(bool comesBack);
  /// Emitted after added() and unlistedChanged().
  void changed();

 private:
  std::vector<OpenStudy> all_;
  Unlisted unlisted_;
};

}  // namespace volumen
