#include "io/archive/receive_into_index.h"
#include "results/text/text.h"
#include "ui/document/job_lane.h"
#include "ui/features/feature.h"
#include "ui/workspace/when_changed.h"

namespace volumen {

namespace {

// Takes studies that others send into the study list, while the user wants that.
class Receiving : public Feature {
 public:
  explicit Receiving(Workbench& bench);

 private:
  void follow();
  void start();
  void addArrived();
  void announce();
  void refuse(const QString& sentence);
  void refuseForGood(const QString& sentence);
  void showAssociation(const ReceivedAssociation& one);

  QAction* action_;
  JobLane lane_, arrivedLane_;
};

// Returns "3 images from PACS".
QString imagesText(int count, const std::string& from) {
  const QString sender = shownText(from);
  return count == 1 ? QObject::tr("1 image from %1").arg(sender)
                    : QObject::tr("%1 images from %2").arg(QString::number(count), sender);
}

Receiving::Receiving(Workbench& bench)
    : Feature(bench),
      action_(bench.addAction({"receiveStudies",
                               tr("Receive studies"),
                               {},
                               "",
                               true,
                               [this](bool on) {
                                 session_.prefer([on](Preferences& p) { p.receives = on; });
                                 follow();
                               },
                               {{"fileMenu", 20, 10}}})) {
  whenChanged(session_, this, &Receiving::follow, &Preferences::receives);
  follow();
  if (!lane_.isBusy()) addArrived();
}

// Takes studies into the study list that came before a program was killed.
void Receiving::addArrived() {
  arrivedLane_.run(
      {},
      [index = bench_.services.indexFolder](const Job& job) { return importArrived(index, job.cancel()); },
      [this](const Result<ImportReport>& imported) {
        if (!imported) return warn(QString::fromStdString(imported.message()));
        if (imported->files > 0) announce();
      });
}

void Receiving::announce() {
  if (StudySource* source = bench_.document.sources.importer()) Q_EMIT source->changed();
}

void Receiving::follow() {
  const bool isWanted = session_.preferences().receives;
  action_->setChecked(isWanted);
  if (!isWanted) return lane_.giveUpAll();
  if (!lane_.isBusy()) start();
}

void Receiving::start() {
  const Result<Archives> archives = readArchives(userArchivesFile());
  if (!archives) return refuseForGood(QString::fromStdString(archives.message()));
  if (!archives->listen)
    return refuseForGood(tr("To receive studies, say in %1 where to listen: "
                            "\"listen\": {\"ae\": \"VOLUMEN\", \"port\": 11112}.")
                             .arg(QString::fromStdString(userArchivesFile())));
  const Listening listening = *archives->listen;
  const std::string index = bench_.services.indexFolder;
  lane_.run(
      {},
      [this, listening, index](const Job& job) {
        ReceiveEvents events;
        events.onListening = [&] {
          lane_.tell(job, [this, listening] {
            tell(tr("Studies that others send to %1, port %2, are received.")
                     .arg(QString::fromStdString(listening.ae))
                     .arg(listening.port));
          });
        };
        events.onEnded = [&](const ReceivedAssociation& one) {
          lane_.tell(job, [this, one] { showAssociation(one); });
        };
        const auto onImported = [&](const Result<ImportReport>& imported) {
          const QString problem = imported ? QString() : QString::fromStdString(imported.message());
          lane_.tell([this, problem] {
            if (!problem.isEmpty()) warn(problem);
            announce();
          });
        };
        return receiveIntoIndex(listening, index, events, onImported, job.cancel());
      },
      [this](const Result<ReceiveReport>& ended) {
        if (!ended) refuse(QString::fromStdString(ended.message()));
      });
}

// The next start, or a click, tries again: another program may use the port.
void Receiving::refuse(const QString& sentence) {
  action_->setChecked(false);
  warnUntilDone(sentence);
}

void Receiving::refuseForGood(const QString& sentence) {
  session_.prefer([](Preferences& p) { p.receives = false; });
  warnUntilDone(sentence);
}

void Receiving::showAssociation(const ReceivedAssociation& one) {
  if (one.stored > 0) tell(tr("Received %1.").arg(imagesText(one.stored, one.callingAe)));
  if (one.problem.empty()) return;
  QString problem = shownText(one.problem);
  while (problem.endsWith(QLatin1Char('.'))) problem.chop(1);
  warn(one.refused > 0
           ? tr("%1 could not be received: %2.").arg(imagesText(one.refused, one.callingAe), problem)
           : tr("The connection of %1 %2.").arg(shownText(one.callingAe), problem));
}

}  // namespace

std::unique_ptr<Feature> makeReceiving(Workbench& bench) { return std::make_unique<Receiving>(bench); }

}  // namespace volumen
