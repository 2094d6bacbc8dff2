#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QLocale>
#include <QMenu>
#include <QMessageBox>
#include <QPushButton>
#include <algorithm>

#include "ui/main_window.h"
#include "ui/panels/studies_panel.h"
#include "ui/widgets/banner.h"
#include "ui/widgets/offer_bar.h"
#include "ui/widgets/status_line.h"
#include "ui/workspace/text.h"

namespace volumen {

namespace {

QString filter() { return MainWindow::tr("Sessions (*.volumen)"); }

QString lostText(const LostSession& lost) {
  const QString at = QLocale().toString(lost.at, QLocale::ShortFormat);
  if (!lost.savedAs.isEmpty())
    return MainWindow::tr("%1 has changes of %2 that were not saved.")
        .arg(pathText(lost.savedAs.toStdString()), at);
  return MainWindow::tr("volumen was ended before it could save what was open on %1.").arg(at);
}

}  // namespace

void MainWindow::connectSessions() {
  connect(&loader_, &Loader::sessionOpened, this, &MainWindow::showSession);
  connect(&loader_, &Loader::located, this, &MainWindow::showLocated);
  connect(banner_, &Banner::accepted, this, &MainWindow::askWhereMissing);
  connect(&sessionFiles_, &SessionFiles::saved, this, [this](const QString& path) {
    status_->tell(tr("Saved %1").arg(path));
    recent_.add(path);
  });
  connect(&sessionFiles_, &SessionFiles::changed, this, &MainWindow::showNames);
  const auto tell = [this](const QString& sentence) { banner_->tell(sentence); };
  connect(&sessionFiles_, &SessionFiles::failed, this, tell);
  connect(&autosave_, &Autosave::failed, this, tell);
  connect(&autosave_, &Autosave::found, this, &MainWindow::offerLost);
  connect(offer_, &OfferBar::accepted, this, [this] { loader_.openSession(lost_->path); });
  connect(offer_, &OfferBar::refused, this, [this] {
    autosave_.discard(*std::exchange(lost_, {}));
    status_->tell(tr("Kept for a week: File > Restore earlier work"));
  });
  connect(&autosave_, &Autosave::listed, this, &MainWindow::showEarlier);
  connect(&sessionFiles_, &SessionFiles::saved, this, [this] {
    if (std::exchange(closesWhenSaved_, false)) close();
  });
  connect(&sessionFiles_, &SessionFiles::failed, this, [this] { closesWhenSaved_ = false; });
  showEarlier({});
  autosave_.look();
}

// What was discarded; a menu of dates and of the names of session files.
void MainWindow::showEarlier(const std::vector<LostSession>& discarded) {
  earlier_ = discarded;
  earlierMenu_->clear();
  earlierMenu_->setEnabled(!discarded.empty());
  for (const LostSession& each : discarded) {
    const QString at = QLocale().toString(each.at, QLocale::ShortFormat),
                  file = QFileInfo(each.savedAs).fileName();
    const QString text = file.isEmpty() || namesHidden() ? at : tr("%1, changes of %2").arg(at, file);
    earlierMenu_->addAction(QString(text).replace(QLatin1Char('&'), QStringLiteral("&&")), this,
                            [this, path = each.path] { loader_.openSession(path); });
  }
}

void MainWindow::showSession(const QString& path, const OpenedSession& opened) {
  const bool isLost = lost_ && lost_->path == path;
  const auto earlier = std::ranges::find(earlier_, path, &LostSession::path);
  const bool restores = isLost || earlier != earlier_.end();
  for (const auto& [place, study] : opened.studies)
    document_.opener.list(QString::fromStdString(place), study);
  session_.open(restores ? tr("Restore") : tr("Open session"), opened.workspace);
  for (const QString& problem : opened.problems) banner_->add(problem);
  offerToLocate();
  if (restores) {
    sessionFiles_.restored(QString::fromStdString(opened.savedAs));
    autosave_.replace(isLost ? *std::exchange(lost_, {}) : *earlier);
    return autosave_.look();
  }
  sessionFiles_.opened(path);
  recent_.add(path);
}

// Where the workspace misses something.
void MainWindow::offerToLocate() {
  if (!missingOf(session_.workspace(), open_.references()).empty() && !banner_->isHidden())
    banner_->offer(tr("Locate..."));
}

void MainWindow::askWhereMissing() {
  auto* dialog = new QFileDialog(this, tr("The folder that it lies in by now"));
  dialog->setObjectName(QStringLiteral("locateDialog"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(QFileDialog::Directory);
  connect(dialog, &QFileDialog::fileSelected, this, [this](const QString& folder) {
    loader_.locate(missingOf(session_.workspace(), open_.references()),
                   QDir::cleanPath(QFileInfo(folder).absoluteFilePath()));
  });
  dialog->open();
}

void MainWindow::showLocated(const Located& located) {
  banner_->hide();
  if (!located.series.empty() || !located.references.empty()) {
    document_.opener.list(QString::fromStdString(located.folder), located.study);
    session_.endGesture();
    session_.change(tr("Locate"), withLocated(session_.workspace(), located));
    session_.endGesture();
  }
  for (const QString& problem : located.problems) banner_->add(problem);
  offerToLocate();
}

void MainWindow::offerLost(const LostSession& lost) {
  lost_ = lost;
  offer_->offer(lostText(lost), tr("Restore"), tr("Discard"));
}

// What closing the window would lose; empty: nothing.
QString MainWindow::unsavedText() const {
  QStringList parts{workText(sessionFiles_.unsavedWork())};
  for (const auto& feature : features_) parts << feature->unsavedText();
  parts.removeAll(QString());
  return parts.join(QStringLiteral(", "));
}

// Once, where something that was made by hand would be lost.
void MainWindow::askBeforeClosing(const QString& lost) {
  auto* box = new QMessageBox(QMessageBox::Question, QStringLiteral("volumen"),
                              tr("Not saved: %1.").arg(lost), QMessageBox::Cancel, this);
  box->setObjectName(QStringLiteral("closeBox"));
  box->setTextFormat(Qt::PlainText);
  box->setAttribute(Qt::WA_DeleteOnClose);
  box->setDefaultButton(QMessageBox::Cancel);
  if (!sessionFiles_.unsavedWork().empty()) {
    QPushButton* save = box->addButton(tr("Save session..."), QMessageBox::AcceptRole);
    connect(save, &QPushButton::clicked, this, &MainWindow::saveAndClose);
    box->setDefaultButton(save);
    box->setInformativeText(tr("What is not saved is kept for a week: File > Restore earlier work."));
  }
  connect(box->addButton(tr("Close without saving"), QMessageBox::DestructiveRole), &QPushButton::clicked,
          this, [this] {
            autosave_.setAtEnd(AtEnd::aside);
            closesUnasked_ = true;
            close();
          });
  box->open();
}

void MainWindow::saveAndClose() {
  session_.endGesture();
  session_.change(tr("Bring back what was measured"), withClosed(session_.workspace()));
  closesWhenSaved_ = true;
  saveSession();
  for (const auto* dialog : findChildren<QFileDialog*>(QStringLiteral("saveSessionDialog")))
    connect(dialog, &QDialog::rejected, this, [this] { closesWhenSaved_ = false; });
}

void MainWindow::end() {
  if (!sessionFiles_.unsavedWork().empty()) autosave_.setAtEnd(AtEnd::keep);
  closesUnasked_ = true;
  close();
}

void MainWindow::saveSession() {
  if (sessionFiles_.path().isEmpty()) return askForSessionFile();
  sessionFiles_.save(sessionFiles_.path());
}

void MainWindow::askForSession() {
  auto* dialog = new QFileDialog(this, tr("Open a session"), {}, filter());
  dialog->setObjectName(QStringLiteral("openSessionDialog"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(QFileDialog::ExistingFile);
  connect(dialog, &QFileDialog::fileSelected, this, [this](const QString& path) { open({path}); });
  dialog->open();
}

void MainWindow::askForSessionFile() {
  if (session_.workspace().series.empty()) return banner_->tell(tr("Open a series first."));
  auto* dialog =
      new QFileDialog(this, tr("Save the session"), QFileInfo(sessionFiles_.path()).path(), filter());
  dialog->setObjectName(QStringLiteral("saveSessionDialog"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setAcceptMode(QFileDialog::AcceptSave);
  dialog->setDefaultSuffix(QStringLiteral("volumen"));
  const QString name = QFileInfo(sessionFiles_.path()).fileName();
  dialog->selectFile(name.isEmpty() ? QStringLiteral("session.volumen") : name);
  connect(dialog, &QFileDialog::fileSelected, &sessionFiles_, &SessionFiles::save);
  dialog->open();
}

}  // namespace volumen
