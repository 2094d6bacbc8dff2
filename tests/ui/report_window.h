#pragma once

#include <QCheckBox>
#include <QPushButton>
#include <QTemporaryDir>

#include "tests/ui/leaving.h"
#include "tests/ui/pdf_images.h"
#include "tests/ui/segment_window.h"

namespace volumen::tests {

/// Returns hollowBalls() as a series of a patient and a study, whose 40 slices can be key images.
inline LoadedSeriesPtr reportedBalls(const char* patient = "Doe^Jane") {
  auto series = std::make_shared<LoadedSeries>(*hollowBalls());
  series->series.patientName = patient;
  series->series.studyDate = "20260314";
  for (int n = 0; n < 40; ++n) {
    series->series.sopInstanceUids.push_back(series->series.id + "." + std::to_string(n));
    series->series.frames.push_back(0);
  }
  return series;
}

/// Returns a length along x that is `mm` long and begins at (0, 0, 0.5) mm in patient space.
inline Shape namedLength(const QString& name, double mm) {
  Shape shape;
  shape.points = {{0, 0, 0.5}, {mm, 0, 0.5}};
  shape.name = name.toStdString();
  return shape;
}

/// A window that makes reports of its key images, measurements and segments.
struct ReportWindow : SegmentWindow {
  QTemporaryDir folder;

  explicit ReportWindow(const LoadedSeriesPtr& series = reportedBalls()) : SegmentWindow(series) {}

  /// Returns true once the view shows a picture and all its measurements have numbers.
  bool isDrawn() {
    return QTest::qWaitFor([&] { return view() && !view()->picture().isNull() && view()->isMeasured(); },
                           longest);
  }
  void markPicture() {
    view()->setFocus();
    QTest::keyClick(&window, Qt::Key_K);
  }
  /// Opens the dialog of the report. Returns null if it does not open.
  PagesDialog* askForReport() {
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    run(*this, "keyImagePages");
    for (auto* dialog : window.findChildren<PagesDialog*>())
      if (dialog->isVisible()) return dialog;
    return nullptr;
  }
  QCheckBox* box(PagesDialog* dialog, const char* name) {
    return dialog->findChild<QCheckBox*>(QLatin1String(name));
  }
  void toggle(QCheckBox* field) { QTest::mouseClick(field, Qt::LeftButton, {}, {8, field->height() / 2}); }

  /// Presses the button that prints or saves the report and chooses a new file for it. Returns its path once
  /// the file is written, or an empty path if that takes too long.
  QString made(PagesDialog* dialog, bool onPaper = false) {
    const QString path = folder.filePath(QStringLiteral("report-%1.pdf").arg(made_++));
    QTest::mouseClick(dialog->findChild<QPushButton*>(QLatin1String(onPaper ? "pagesPrint" : "pagesPdf")),
                      Qt::LeftButton);
    answerWhere(
        *this,
        wayOut(onPaper ? QStringLiteral("key images to paper") : QStringLiteral("key images to a PDF")),
        path);
    const auto isThere = [&] { return QFileInfo(path).size() > 0 && window.jobs().rows().empty(); };
    return QTest::qWaitFor(isThere, longest) ? path : QString();
  }

 private:
  int made_ = 0;
};

/// Returns the texts of a PDF in the order in which they were painted, separated by blanks.
inline QString paintedText(const QString& path) { return textsIn(path).join(QLatin1Char(' ')).simplified(); }

}  // namespace volumen::tests
