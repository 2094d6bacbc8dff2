#pragma once

#include <QString>

#include "io/study/unread.h"
#include "viewer/volume/histogram.h"

namespace volumen {

struct DerivedObject;
struct Series;
struct Study;

/// What the program says, in the language of its user.
QString tr(const char* text);

/// Text from a file as a person may read it: control characters become blanks, those that
/// reorder text are left out, blanks trimmed.
QString shownText(const std::string& utf8);

/// While on, patientText(), dateText() and pathText() say that there is something hidden, and seriesText()
/// leaves file names out: one switch behind all that is shown, so that no window can forget it.
void hideNames(bool hidden);
bool namesHidden();

/// Hides names, where `hidden`, for as long as it lives: for what is made for others.
class HidingNames {
 public:
  explicit HidingNames(bool hidden) : before_(namesHidden()) { hideNames(before_ || hidden); }
  ~HidingNames() { hideNames(before_); }
  HidingNames(const HidingNames&) = delete;
  HidingNames& operator=(const HidingNames&) = delete;

 private:
  const bool before_;
};

/// "Doe, Jane" of "Doe^Jane=...": the first group of a DICOM name (PS3.5 6.2.1.1) that is not
/// empty, its carets read as a name; empty where there is none.
QString personText(const std::string& name);

/// "Doe, Jane (12345)": DICOM's carets read as a name; "(no name)" where a DICOM file names none; empty
/// for what has no patients.
QString patientText(const Series& series);
/// The same of an object of a DICOM file.
QString patientText(const DerivedObject& object);

/// "CT Head 1.0 mm (3)": modality, description, number; "head.nii" of other files.
QString seriesText(const Series& series);

/// "2026-03-14 CT head": date ("(no date)" where a DICOM file has none) and description of the study.
QString studyText(const Series& series);

/// "8 files could not be read; 77 others are not images.": what of a folder is not shown; empty where all of
/// it is.
QString unreadText(const Study& study);

/// "/data/a.dcm: cut off": each of them.
QStringList refusedTexts(const std::vector<Refused>& refused);

/// The same where only volumes count: "1 picture is no volume." behind it.
QString noVolumesText(const Study& study);

/// "Anterior view" of the standard view "anterior".
QString viewText(const QString& name);

/// The unit of the numbers on screen, as it stands behind one: " HU"; empty where the values have none.
QString unitSuffix(const Series& series);

/// How many decimals tell values of this range apart: 1 for CT, more for what lies between 0 and 1.
int valueDecimals(const Histogram& histogram);

/// The path of a file as a person may read it.
QString pathText(const std::string& path);

/// "2026-03-14" of DICOM's 20260314.
QString dateText(const std::string& dicomDate);

/// "10:22:31" of DICOM's 102231.25, "10:22" of its 1022.
QString timeText(const std::string& dicomTime);

}  // namespace volumen
