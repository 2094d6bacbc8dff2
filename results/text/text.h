#pragma once

#include <QString>

#include "io/study/unread.h"
#include "viewer/volume/histogram.h"

namespace volumen {

struct DerivedObject;
struct Series;
struct Study;

/// Returns a text of the program in the user's language.
QString tr(const char* text);

/// Returns text from a file for people. Control characters become blanks, characters that reorder text are
/// left out, and blanks are trimmed.
QString shownText(const std::string& utf8);

/// While on, patientText(), dateText() and pathText() say that something is hidden, and seriesText() leaves
/// out file names. One switch serves all text on screen, so that no window can forget it.
void hideNames(bool hidden);
bool namesHidden();

/// Hides or shows names during its lifetime, for output as it was requested.
class HidingNames {
 public:
  explicit HidingNames(bool hidden) : before_(namesHidden()) { hideNames(hidden); }
  ~HidingNames() { hideNames(before_); }
  HidingNames(const HidingNames&) = delete;
  HidingNames& operator=(const HidingNames&) = delete;

 private:
  const bool before_;
};

/// Returns "Doe, Jane" for "Doe^Jane=...": the first non-empty group of a DICOM name (PS3.5 6.2.1.1) without
/// carets. Empty if there is none.
QString personText(const std::string& name);

/// Returns "Doe, Jane (12345)", or "(no name)" if a DICOM file names none. Empty for formats without
/// patients.
QString patientText(const Series& series);
/// Returns the same for an object from a DICOM file.
QString patientText(const DerivedObject& object);

/// Returns modality, description and number, "CT Head 1.0 mm (3)", or the file name of other formats,
/// "head.nii".
QString seriesText(const Series& series);

/// Returns date ("(no date)" if a DICOM file has none) and description of a study: "2026-03-14 CT head".
QString studyText(const Series& series);

/// Returns how many files of a folder are not shown: "8 files could not be read; 77 others are not images."
/// Empty if all are.
QString unreadText(const Study& study);

/// Returns path and reason of each: "/data/a.dcm: cut off".
QStringList refusedTexts(const std::vector<Refused>& refused);

/// Returns the same if only volumes count, followed by "1 picture is no volume."
QString noVolumesText(const Study& study);

/// Returns "Anterior view" for the standard view "anterior".
QString viewText(const QString& name);

/// Returns the displayed unit as it follows a number, " HU"; empty if the values have none.
QString unitSuffix(const Series& series);

/// Returns how many decimals distinguish values of this range: 1 for CT, more for values between 0 and 1.
int valueDecimals(const Histogram& histogram);

/// Returns the path of a file for people.
QString pathText(const std::string& path);

/// Returns "2026-03-14" for DICOM's 20260314.
QString dateText(const std::string& dicomDate);

/// Returns "10:22:31" for DICOM's 102231.25, and "10:22" for its 1022.
QString timeText(const std::string& dicomTime);

}  // namespace volumen
