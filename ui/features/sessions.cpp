#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QMenu>
#include <QMessageBox>
#include <QPointer>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>

#include "results/text/series_text.h"
#include "results/text/text.h"
#include "ui/controller/autosave.h"
#include "ui/features/feature.h"
#include "ui/widgets/banner.h"
#include "ui/widgets/offer_bar.h"
#include "ui/workspace/when_changed.h"

namespace volumen {

namespace {

QString filter() { return QObject::tr("Sessions (*.volumen)"); }

QString timeOf(const LostSession& lost) { return lost.at.toString(QStringLiteral("yyyy-MM-dd HH:mm")); }

// Returns the patients, such as "Doe, Jane (12345); Roe, Richard (7)".
QString patientsOf(const LostSession& lost) {
  QStringList names;
  for (const SavedPatient& patient : lost.patients) {
    Series series;
    series.patientName = patient.name, series.patientId = patient.id;
    names << patientText(series);
  }
  names.removeDuplicates();
  return names.join(QStringLiteral("; "));
}

QString lostText(const LostSession& lost) {
  const QString at = timeOf(lost), patients = patientsOf(lost);
  const QString text =
      lost.savedAs.isEmpty()
          ? tr("volumen was ended before it could save what was open on %1.").arg(at)
          : tr("%1 has changes of %2 that were not saved.").arg(pathText(lost.savedAs.toStdString()), at);
  return patients.isEmpty() ? text : tr("%1 Patient: %2.").arg(text, patients);
}

// Blocks both windows, as sessions belong to both.
void openOverBoth(QDialog* dialog) {
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setWindowModality(Qt::ApplicationModal);
  dialog->show();
}

// Opens and saves sessions. Restores unsaved work at the start, asks before the window closes, and names
// session and series in the title.
class Sessions : public Feature {
 public:
  explicit Sessions(Workbench& bench);

  QString unsavedText() const override { return workText(files_.unsavedWork()); }
  bool mayClose(const QString& lost) override;
  void closeUnasked() override;

 private:
  void makeActions();
  void connectFiles();
  void connectAutosave();
  void showTitle();
  void showSession(const QString& path, const OpenedSession& opened);
  void offerToLocate();
  void askWhereMissing();
  void showLocated(const Located& located);
  void saveSession();
  void askForSession();
  void askForSessionFile();
  void offerLost(const LostSession& lost);
  void askBeforeDiscarding();
  void showEarlier(const std::vector<LostSession>& discarded);
  void askBeforeClosing(const QString& lost);
  void closeWithoutSaving(const QString& lost);
  void saveAndClose();
  void quit() { bench_.window.close(); }

  SessionFiles& files_;
  Autosave autosave_;
  OfferBar* offer_;
  QMenu* earlierMenu_;
  std::optional<LostSession> lost_;   // session offered or being restored
  std::vector<LostSession> earlier_;  // discarded within a week
  bool closesWhenSaved_ = false;      // set if the window closes after saving
  bool closesUnasked_ = false;
  QString whyNotKept_;  // why autosave cannot keep what closing would lose
  QPointer<QMessageBox> closeBox_;
};

Sessions::Sessions(Workbench& bench)
    : Feature(bench),
      files_(bench.document.files),
      autosave_(session_, files_),
      offer_(new OfferBar),
      earlierMenu_(bench.addMenu("earlierMenu", tr("Restore earlier work"), {{"fileMenu", 40}})) {
  bench_.column.insertWidget(0, offer_);
  makeActions();
  connectFiles();
  connectAutosave();
  whenChanged(session_, this, &Sessions::showTitle, showsOther, &Preferences::hideNames);
  whenChanged(
      session_, this, [this] { showEarlier(std::vector(earlier_)); }, &Preferences::hideNames);
  showEarlier({});
  autosave_.look();
}

void Sessions::makeActions() {
  const auto add = [this](const char* name, const QString& text, const QList<QKeySequence>& keys, int group,
                          void (Sessions::*run)()) {
    bench_.addAction(
        {name, text, keys, "", false, [this, run](bool) { (this->*run)(); }, {{"fileMenu", group}}});
  };
  add("openSession", tr("Open session..."), {}, 30, &Sessions::askForSession);
  add("saveSession", tr("Save session"), {QKeySequence::Save}, 30, &Sessions::saveSession);
  add("saveSessionAs", tr("Save session as..."), {tr("Ctrl+Shift+S")}, 30, &Sessions::askForSessionFile);
  add("quit", tr("Quit"), {QKeySequence::Quit}, 60, &Sessions::quit);
}

void Sessions::connectFiles() {
  connect(&bench_.document.loader, &Loader::sessionOpened, this, &Sessions::showSession);
  connect(&bench_.document.loader, &Loader::located, this, &Sessions::showLocated);
  connect(&bench_.banner, &Banner::accepted, this, &Sessions::askWhereMissing);
  connect(&files_, &SessionFiles::changed, this, &Sessions::showTitle);
  connect(&files_, &SessionFiles::saved, this, [this](const QString& path) {
    tell(tr("Saved %1").arg(path));
    bench_.document.recent.add(path);
    if (std::exchange(closesWhenSaved_, false)) bench_.window.close();
  });
  connect(&files_, &SessionFiles::failed, this, [this](const QString& sentence) {
    closesWhenSaved_ = false;
    warnUntilDone(sentence);
  });
}

void Sessions::connectAutosave() {
  connect(&autosave_, &Autosave::failed, this, [this](const QString& sentence) { warnUntilDone(sentence); });
  connect(&autosave_, &Autosave::found, this, &Sessions::offerLost);
  connect(&autosave_, &Autosave::listed, this, &Sessions::showEarlier);
  connect(offer_, &OfferBar::accepted, this, [this] { bench_.document.loader.openSession(lost_->path); });
  connect(offer_, &OfferBar::refused, this, &Sessions::askBeforeDiscarding);
}

bool Sessions::mayClose(const QString& lost) {
  if (closesUnasked_ || lost.isEmpty()) return true;
  if (!closeBox_) {
    whyNotKept_.clear();
    askBeforeClosing(lost);
  }
  return false;
}

void Sessions::closeUnasked() {
  if (!files_.unsavedWork().empty()) autosave_.setAtEnd(AtEnd::keep);
  closesUnasked_ = true;
}

// Shows the patient and series in focus and the session file in the title.
void Sessions::showTitle() {
  QMainWindow& window = bench_.window;
  const Series* series = seriesIn(session_.workspace(), session_.workspace().focus);
  const QString file = QFileInfo(files_.path()).fileName();
  const bool named = !file.isEmpty() && !namesHidden();
  QStringList parts;
  if (series) parts << patientText(*series) << seriesText(*series);
  if (named) parts << file + QStringLiteral("[*]");
  parts << QStringLiteral("volumen");
  parts.removeAll(QString());
  window.setWindowTitle(parts.join(QStringLiteral(" - ")));
  window.setWindowModified(named && files_.modified());
}

// Fills the menu of discarded sessions: dates, patients and session file names.
void Sessions::showEarlier(const std::vector<LostSession>& discarded) {
  earlier_ = discarded;
  earlierMenu_->clear();
  earlierMenu_->setEnabled(!discarded.empty());
  for (const LostSession& each : discarded) {
    const QString file = QFileInfo(each.savedAs).fileName();
    QStringList parts{timeOf(each)};
    if (!namesHidden()) parts << patientsOf(each);
    if (!namesHidden() && !file.isEmpty()) parts << tr("changes of %1").arg(file);
    parts.removeAll(QString());
    const QString text = parts.join(QStringLiteral(", "));
    earlierMenu_->addAction(QString(text).replace(QLatin1Char('&'), QStringLiteral("&&")), this,
                            [this, path = each.path] { bench_.document.loader.openSession(path); });
  }
}

void Sessions::showSession(const QString& path, const OpenedSession& opened) {
  const bool isLost = lost_ && lost_->path == path;
  const auto earlier = std::ranges::find(earlier_, path, &LostSession::path);
  const bool restores = isLost || earlier != earlier_.end();
  for (const auto& [place, study] : opened.studies)
    bench_.document.opener.list(QString::fromStdString(place), study);
  session_.open(restores ? tr("Restore") : tr("Open session"), opened.workspace);
  for (const QString& problem : opened.problems) bench_.banner.add(problem);
  offerToLocate();
  if (restores) {
    files_.restored(QString::fromStdString(opened.savedAs), opened.saved);
    files_.savedApart(opened.exported);
    // Keeps a session with unreadable parts, as they may be readable later.
    if (opened.segmentsAreWhole)
      autosave_.replace(isLost ? *std::exchange(lost_, {}) : *earlier);
    else if (isLost)
      autosave_.discard(*std::exchange(lost_, {}));
    return autosave_.look();
  }
  files_.opened(path);
  bench_.document.recent.add(path);
}

// Offers to locate missing files.
void Sessions::offerToLocate() {
  if (!missingOf(session_.workspace(), open_.derived()).empty() && !bench_.banner.isHidden())
    bench_.banner.offer(tr("Locate..."));
}

void Sessions::askWhereMissing() {
  auto* dialog = new QFileDialog(bench_.dialogParent(), tr("The folder that it lies in by now"));
  dialog->setObjectName(QStringLiteral("locateDialog"));
  dialog->setFileMode(QFileDialog::Directory);
  connect(dialog, &QFileDialog::fileSelected, this, [this](const QString& folder) {
    bench_.document.loader.locate(missingOf(session_.workspace(), open_.derived()),
                                  QDir::cleanPath(QFileInfo(folder).absoluteFilePath()));
  });
  openOverBoth(dialog);
}

void Sessions::showLocated(const Located& located) {
  bench_.banner.hide();
  if (!located.series.empty() || !located.derived.empty()) {
    bench_.document.opener.list(QString::fromStdString(located.folder), located.study);
    session_.endGesture();
    session_.change(tr("Locate"), withLocated(session_.workspace(), located));
    session_.endGesture();
  }
  for (const QString& problem : located.problems) bench_.banner.add(problem);
  offerToLocate();
}

void Sessions::offerLost(const LostSession& lost) {
  lost_ = lost;
  offer_->offer(lostText(lost), tr("Restore"), tr("Discard"));
}

// Asks first and shows the offer again on cancel.
void Sessions::askBeforeDiscarding() {
  auto* box = new QMessageBox(QMessageBox::Question, QStringLiteral("volumen"),
                              tr("Discard what was not saved? %1").arg(lostText(*lost_)), QMessageBox::Cancel,
                              bench_.dialogParent());
  box->setObjectName(QStringLiteral("discardBox"));
  box->setTextFormat(Qt::PlainText);
  box->setInformativeText(tr("It is kept for a week: File > Restore earlier work."));
  box->setDefaultButton(QMessageBox::Cancel);
  QPushButton* discard = box->addButton(tr("Discard"), QMessageBox::DestructiveRole);
  connect(box, &QDialog::finished, this, [this, box, discard] {
    if (box->clickedButton() != discard) return offer_->show();
    autosave_.discard(*std::exchange(lost_, {}));
    tell(tr("Kept for a week: File > Restore earlier work"));
  });
  openOverBoth(box);
}

// Asks once if manual work would be lost.
void Sessions::askBeforeClosing(const QString& lost) {
  auto* box = new QMessageBox(QMessageBox::Question, QStringLiteral("volumen"),
                              tr("Not saved: %1.").arg(lost), QMessageBox::Cancel, bench_.dialogParent());
  closeBox_ = box;
  box->setObjectName(QStringLiteral("closeBox"));
  box->setTextFormat(Qt::PlainText);
  box->setDefaultButton(QMessageBox::Cancel);
  if (!files_.unsavedWork().empty()) {
    QPushButton* save = box->addButton(tr("Save session..."), QMessageBox::AcceptRole);
    connect(save, &QPushButton::clicked, this, &Sessions::saveAndClose);
    box->setDefaultButton(save);
    box->setInformativeText(whyNotKept_.isEmpty()
                                ? tr("What is not saved is kept for a week: File > Restore earlier work.")
                                : tr("What is not saved cannot be kept: %1").arg(whyNotKept_));
  }
  connect(box->addButton(tr("Close without saving"), QMessageBox::DestructiveRole), &QPushButton::clicked,
          this, [this, lost] { closeWithoutSaving(lost); });
  openOverBoth(box);
}

// Asks again if the work cannot be kept for a week as promised.
void Sessions::closeWithoutSaving(const QString& lost) {
  if (const Status kept = autosave_.keepNow(); !kept && whyNotKept_.isEmpty()) {
    whyNotKept_ = shownText(kept.message());
    return askBeforeClosing(lost);
  }
  autosave_.setAtEnd(AtEnd::aside);
  closesUnasked_ = true;
  bench_.window.close();
}

void Sessions::saveAndClose() {
  session_.endGesture();
  session_.change(tr("Bring back what was measured"), withClosed(session_.workspace()));
  closesWhenSaved_ = true;
  saveSession();
}

void Sessions::saveSession() {
  if (files_.path().isEmpty()) return askForSessionFile();
  files_.save(files_.path());
}

void Sessions::askForSession() {
  auto* dialog = new QFileDialog(bench_.dialogParent(), tr("Open a session"), {}, filter());
  dialog->setObjectName(QStringLiteral("openSessionDialog"));
  dialog->setFileMode(QFileDialog::ExistingFile);
  connect(dialog, &QFileDialog::fileSelected, this,
          [this](const QString& path) { Q_EMIT bench_.openRequested({path}); });
  openOverBoth(dialog);
}

void Sessions::askForSessionFile() {
  if (session_.workspace().series.empty()) return warn(tr("Open a series first."));
  auto* dialog = new QFileDialog(bench_.dialogParent(), tr("Save the session"),
                                 QFileInfo(files_.path()).path(), filter());
  dialog->setObjectName(QStringLiteral("saveSessionDialog"));
  dialog->setAcceptMode(QFileDialog::AcceptSave);
  dialog->setDefaultSuffix(QStringLiteral("volumen"));
  const QString name = QFileInfo(files_.path()).fileName();
  dialog->selectFile(name.isEmpty() ? QStringLiteral("session.volumen") : name);
  connect(dialog, &QFileDialog::fileSelected, &files_, &SessionFiles::save);
  connect(dialog, &QDialog::rejected, this, [this] { closesWhenSaved_ = false; });
  openOverBoth(dialog);
}

}  // namespace

std::unique_ptr<Feature> makeSessions(Workbench& bench) { return std::make_unique<Sessions>(bench); }

}  // namespace volumen
