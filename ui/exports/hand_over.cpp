#include "ui/exports/hand_over.h"

#include <QDir>
#include <QDirIterator>
#include <QLocale>
#include <QTemporaryDir>
#include <algorithm>

#include "io/archive/send_archive.h"
#include "io/deidentify/deidentify_files.h"
#include "io/deidentify/pseudonyms.h"
#include "io/files/aside.h"
#include "results/text/text.h"
#include "viewer/volume/free_name.h"

namespace volumen {

namespace {

QString inDigits(std::size_t number) { return QLocale().toString(qulonglong(number)); }

// Returns the reason that all share; empty if there is none.
QString commonReason(const std::vector<Refused>& failed) {
  const auto isFirst = [&](const Refused& each) { return each.reason == failed[0].reason; };
  return !failed.empty() && std::ranges::all_of(failed, isFirst) ? shownText(failed[0].reason) : QString();
}

Result<HandedOver> sent(const LeavingFiles& leaving, const Archive& archive, const Job& job) {
  const Progress progress = [&](const char*, std::size_t done, std::size_t total) {
    job.tell(tr("image %1 of %2").arg(inDigits(done), inDigits(total)), double(done) / double(total));
  };
  const auto report = sendToArchive(archive, leaving.files, progress, job.cancel());
  if (!report) return report.error();
  QStringList sentences{tr("Sent %1 of %2 images to %3.")
                            .arg(inDigits(std::size_t(report->sent)),
                                 inDigits(std::size_t(report->instances)),
                                 QString::fromStdString(archive.name))};
  sentences << commonReason(report->failed);
  const std::size_t others = report->notDicom.size();
  if (others == 1) sentences << tr("1 file holds no image to send.");
  if (others > 1) sentences << tr("%1 files hold no image to send.").arg(inDigits(others));
  std::vector<Refused> lost = report->failed;
  lost.insert(lost.end(), report->notDicom.begin(), report->notDicom.end());
  sentences.removeAll(QString());
  return HandedOver{sentences.join(QLatin1Char(' ')), refusedTexts(lost)};
}

Error cannotWrite(const QString& path) {
  return {tr("Cannot write %1: choose another folder, or free some space.").arg(path).toStdString()};
}

// Copies files into a folder by numbers.
Status copyInto(const QString& folder, const LeavingFiles& leaving, const Job& job) {
  const std::size_t count = leaving.files.size();
  for (std::size_t n = 0; n < count; ++n) {
    if (job.cancelled()) return Error{tr("Cancelled.").toStdString()};
    const QString file = folder + QStringLiteral("/%1.dcm").arg(n + 1, 5, 10, QLatin1Char('0'));
    if (!QFile::copy(QString::fromStdString(leaving.files[n]), file)) return cannotWrite(file);
    job.tell(tr("file %1 of %2").arg(inDigits(n + 1), inDigits(count)), double(n + 1) / double(count));
  }
  return {};
}

// Copies into a folder aside; it, or the only file in it, then gets the name, or a further one if that is
// taken.
Result<HandedOver> copied(const LeavingFiles& leaving, const QString& name, const QString& parent,
                          const Job& job) {
  auto aside = FolderAside::in(parent.toStdString());
  if (!aside) return cannotWrite(parent);
  const QString inner = QString::fromStdString(aside->path());
  if (Status s = copyInto(inner, leaving, job); !s) return s.error();
  const bool isOne = leaving.files.size() == 1;
  const QString ending = isOne ? QStringLiteral(".dcm") : QString();
  const std::string free = freeName((parent + QLatin1Char('/') + name).toStdString(), [&](const auto& one) {
    return QFileInfo::exists(QString::fromStdString(one) + ending);
  });
  const QString target = QString::fromStdString(free) + ending;
  const bool isThere = isOne ? QFile::rename(inner + QStringLiteral("/00001.dcm"), target)
                             : aside->become(target.toStdString()).ok();
  if (!isThere) return cannotWrite(target);
  return HandedOver{isOne ? tr("Saved %1").arg(target)
                          : tr("Saved %1 files in %2").arg(inDigits(leaving.files.size()), target)};
}

QString lookAt(const QString& what, const std::vector<std::string>& series) {
  return series.empty() ? QString() : what.arg(QLocale().toString(qulonglong(series.size())));
}

// Makes copies without identity in `folder`. `details` receives what was left out and what to look at.
Result<LeavingFiles> withoutIdentity(const LeavingFiles& leaving, bool faceless, const QString& folder,
                                     QStringList& details, const Job& job) {
  const auto key = userPseudonymKey();
  if (!key) return key.error();
  const auto report = deidentifyFiles(leaving.files, folder.toStdString(), {{}, *key, faceless},
                                      job.progress(), job.cancel());
  if (!report) return report.error();
  details << refusedTexts(report->leftOut)
          << lookAt(tr("Names may be burned into the pixels of %1 series: look at them."), report->withText)
          << lookAt(tr("The face was taken away in %1 series of a head: look at a rendering."),
                    report->faceless)
          << lookAt(tr("A face may be recognised in %1 series of a head."), report->withFaces)
          << lookAt(tr("SUV cannot be computed any more in %1 series."), report->withoutSuv)
          << lookAt(tr("%1 series of mosaics can no longer be shown as volumes."), report->withoutMosaic);
  details.removeAll(QString());
  LeavingFiles made;
  QDirIterator all(folder, QDir::Files, QDirIterator::Subdirectories);
  while (all.hasNext()) made.files.push_back(all.next().toStdString());
  std::ranges::sort(made.files);
  if (!made.files.empty()) return made;
  return Error{tr("Nothing could be exported without the patient's identity: %1")
                   .arg(details.join(QLatin1Char(' ')))
                   .toStdString()};
}

}  // namespace

Result<HandedOver> handOver(const LeavingFiles& leaving, const QString& name, const ExportTarget& target,
                            const Job& job) {
  const QTemporaryDir folder;
  LeavingFiles files = leaving;
  QStringList details;
  if (target.deidentified) {
    auto made = withoutIdentity(leaving, target.faceless, folder.path(), details, job);
    if (!made) return made.error();
    files = *std::move(made);
  }
  auto done = target.archive ? sent(files, *target.archive, job) : copied(files, name, target.folder, job);
  if (!done) return done;
  done->sentence = (QStringList(done->sentence) + leaving.notes).join(QLatin1Char(' '));
  done->details = details + done->details;
  return done;
}

}  // namespace volumen
