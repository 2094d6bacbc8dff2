#pragma once

#include <QObject>
#include <QStringList>
#include <memory>
#include <vector>

#include "io/study/study.h"
#include "ui/data/derived_key.h"
#include "ui/data/series_key.h"
#include "ui/workspace/workspace.h"

namespace volumen {

/// What was opened by one path: volumes, and frames of what is no volume.
struct OpenStudy {
  QString path;
  std::shared_ptr<const Study> study;
  std::vector<Series> frames;

  /// First the volumes, then the frames; null beyond them.
  const Series* seriesAt(std::size_t n) const;
  /// The number of a volume of `study`.
  std::size_t numberOf(const Series& volume) const { return std::size_t(&volume - study->volumes.data()); }
  /// The numbers of all, the steps of one series together and in their order.
  std::vector<std::vector<std::size_t>> rows() const;
};

/// The studies that are open, in the order in which they were opened. What was taken off the list stays
/// known, so that undo brings it back.
class OpenStudies : public QObject {
  Q_OBJECT
 public:
  using QObject::QObject;

  /// Adds what a path holds, in place of what it held when it was opened before.
  void add(const QString& path, const std::shared_ptr<const Study>& study);
  /// What of it is not in the list.
  void setUnlisted(const Unlisted& unlisted);
  /// Forgets the paths that hold nothing that can be listed.
  void forgetEmpty();

  const std::vector<OpenStudy>& all() const { return all_; }
  /// By its path; null: it is not known.
  const OpenStudy* find(const QString& path) const;
  /// What was opened by this path; null: nothing that is in the list.
  std::shared_ptr<const Study> studyOf(const QString& path) const;

  bool isListed(const Series& series) const { return !unlisted_.series.contains(keyOf(series)); }
  bool isListed(const DerivedObject& object) const { return !unlisted_.derived.contains(keyOf(object)); }
  /// Whether any of it is, or there is nothing in it to be listed.
  bool isListed(const OpenStudy& opened) const;

  /// All volumes that are in the list.
  std::vector<const Series*> volumes() const;
  /// The same and the frames of what is no volume.
  std::vector<const Series*> pictures() const;
  /// All objects that refer to pictures.
  std::vector<DerivedObjectPtr> derived() const;
  /// The files that have no pictures and are no such objects, each with what it is: "F: DICOM file without
  /// pixel data (CR)".
  QStringList filesWithoutPixels() const;
  /// All that could be listed.
  Unlisted everything() const;

 Q_SIGNALS:
  /// This path holds something else now.
  void added(const QString& path);
  /// Of setUnlisted(); `comesBack`: some of it is in the list again.
  void unlistedChanged(bool comesBack);
  /// After either.
  void changed();

 private:
  std::vector<OpenStudy> all_;
  Unlisted unlisted_;
};

}  // namespace volumen
