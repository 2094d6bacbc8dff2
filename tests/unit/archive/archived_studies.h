#pragma once

#include <QByteArray>
#include <QJsonArray>
#include <QList>
#include <QString>
#include <QStringList>
#include <string>
#include <vector>

namespace volumen::tests {

/// A study as it is archived. Names are bytes of their character sets.
struct ArchivedStudy {
  const char *uid, *name, *charset, *id, *date, *modality, *description;
};

// UIDs are "1.2.1" and so on; the series of each are numbered, "1.2.1.1".
inline constexpr ArchivedStudy archivedStudies[] = {
    {"1.2.1", "DOE^JANE", "", "PID1", "20260314", "CT", "Thorax"},
    {"1.2.2", "doe^john", "", "PID2", "20260315", "MR", "Brain"},
    {"1.2.3", "Buc^J\xe9r\xf4me", "ISO_IR 100", "PID3", "20250101", "CT", "Abdomen"},
    {"1.2.4", "\xbb\xee\xda\x63\x65\xdc\xd1\x79\x70\xd3", "ISO_IR 144", "PID4", "20240101", "MR", "Knie"},
    {"1.2.5", "\x1b$B$d$^$@\x1b(B^\x1b$B$?$m$&\x1b(B", "\\ISO 2022 IR 87", "PID5", "20230101", "CT", "Chest"},
    {"1.2.6", "\xd7\xa9\xd7\xa8\xd7\x95\xd7\x9f", "ISO_IR 192", "PID6", "20220101", "US", "Liver"},
};

/// Writes an image of a series of a study into a folder. Returns its path, which is named after its series.
QString writeArchived(const QString& folder, const ArchivedStudy& study, int series);
/// Writes all studies, and a second series of the first. Returns the paths.
QStringList writeAllArchived(const QString& folder);

/// Returns the bytes of files with images of one series (1.2.1.1), which are numbered from 1.2.1.1.1; at most
/// nine.
QList<QByteArray> instancesOfOneSeries(int count);

/// Returns all files below a folder.
QStringList filesBelow(const QString& folder);

/// Returns the data sets of all files below a folder, sorted. Any that is no .dcm counts as "half-written".
QList<QByteArray> dataSetsBelow(const QString& folder);

/// What a transfer must not change.
struct Instance {
  std::string seriesUid, uid, name;
  std::vector<unsigned short> pixels;
  bool operator==(const Instance&) const = default;
};

/// Returns the instance in a file, decompressed; an empty one if it cannot be read.
Instance instanceIn(const QString& path);

/// Returns where the data set of a file begins, behind its file meta information.
qsizetype beginOfData(const QByteArray& file);

/// Returns a file that names the transfer syntax `to` instead of `from`, with the same data set.
QByteArray renamed(QByteArray file, const QByteArray& from, QByteArray to);

/// Returns the UIDs of studies in JSON, sorted.
QStringList uidsOf(const QJsonArray& studies);

}  // namespace volumen::tests
