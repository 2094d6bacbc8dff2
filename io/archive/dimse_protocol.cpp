// Archives that are asked by DIMSE (PS3.4 C, PS3.7).
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcuid.h>

#include <algorithm>
#include <map>
#include <optional>

#include "io/archive/association.h"
#include "io/archive/data_sets.h"
#include "io/archive/move.h"
#include "io/archive/protocol.h"
#include "io/archive/send_dimse.h"
#include "io/archive/stored_syntaxes.h"

namespace volumen {

namespace {

constexpr const char* findModel = UID_FINDStudyRootQueryRetrieveInformationModel;
constexpr const char* getModel = UID_GETStudyRootQueryRetrieveInformationModel;

// One context for the model and one for each class and syntax; there are 128.
constexpr std::size_t mostClasses = 7;

// The classes that series of a modality hold, where an archive does not tell them.
std::vector<std::string> classesOf(const std::string& modality) {
  static const std::map<std::string, std::vector<std::string>> usual{
      {"CT", {UID_CTImageStorage, UID_EnhancedCTImageStorage}},
      {"MR", {UID_MRImageStorage, UID_EnhancedMRImageStorage}},
      {"PT", {UID_PositronEmissionTomographyImageStorage, UID_EnhancedPETImageStorage}},
      {"NM", {UID_NuclearMedicineImageStorage}},
      {"CR", {UID_ComputedRadiographyImageStorage}},
      {"DX",
       {UID_DigitalXRayImageStorageForPresentation, UID_DigitalXRayImageStorageForProcessing,
        UID_ComputedRadiographyImageStorage}},
      {"MG",
       {UID_DigitalMammographyXRayImageStorageForPresentation,
        UID_DigitalMammographyXRayImageStorageForProcessing, UID_BreastTomosynthesisImageStorage}},
      {"XA", {UID_XRayAngiographicImageStorage, UID_EnhancedXAImageStorage}},
      {"RF", {UID_XRayRadiofluoroscopicImageStorage, UID_EnhancedXRFImageStorage}},
      {"US", {UID_UltrasoundImageStorage, UID_UltrasoundMultiframeImageStorage}},
      {"SEG", {UID_SegmentationStorage}},
      {"RTSTRUCT", {UID_RTStructureSetStorage}},
      {"RTDOSE", {UID_RTDoseStorage}},
      {"RTPLAN", {UID_RTPlanStorage}},
      {"SR",
       {UID_BasicTextSRStorage, UID_EnhancedSRStorage, UID_ComprehensiveSRStorage,
        UID_Comprehensive3DSRStorage, UID_XRayRadiationDoseSRStorage}},
      {"KO", {UID_KeyObjectSelectionDocumentStorage}},
      {"PR", {UID_GrayscaleSoftcopyPresentationStateStorage, UID_ColorSoftcopyPresentationStateStorage}},
      {"DOC", {UID_EncapsulatedPDFStorage}}};
  const auto found = usual.find(modality);
  std::vector<std::string> classes = found == usual.end() ? std::vector<std::string>() : found->second;
  classes.push_back(UID_SecondaryCaptureImageStorage);
  classes.push_back(UID_MultiframeTrueColorSecondaryCaptureImageStorage);
  return classes;
}

// Some archives (dcmqrscp) send all of a class in the syntax that is offered first, or not at all.
std::vector<WantedService> servicesFor(const std::vector<std::string>& classes, bool uncompressedFirst) {
  std::vector<std::string> syntaxes = storedSyntaxes;
  if (uncompressedFirst) std::ranges::reverse(syntaxes);
  std::vector<WantedService> services{plainService(getModel)};
  for (const std::string& sopClass : classes)
    for (const std::string& syntax : syntaxes) services.push_back({sopClass, {syntax}, true});
  return services;
}

// All classes that DCMTK knows, without compression.
std::vector<WantedService> servicesForAny() {
  std::vector<WantedService> services{plainService(getModel)};
  for (int n = 0; n < numberOfDcmLongSCUStorageSOPClassUIDs; ++n) {
    services.push_back(plainService(dcmLongSCUStorageSOPClassUIDs[n]));
    services.back().isReceived = true;
  }
  return services;
}

class DimseProtocol : public ArchiveProtocol {
 public:
  DimseProtocol(const Archive& archive, const CancelToken& cancel) : archive_(archive), cancel_(cancel) {}

  Status test() override {
    auto association = Association::open(archive_, {plainService(UID_VerificationSOPClass)}, cancel_);
    return association ? association->echo() : association.error();
  }

  Result<SearchEnd> find(DcmDataset& keys, const std::function<bool(DcmDataset&)>& onAnswer) override {
    if (!finder_) {
      auto association = Association::open(archive_, {plainService(findModel)}, cancel_);
      if (!association) return association.error();
      finder_.emplace(std::move(*association));
    }
    const auto refusal = finder_->find(findModel, keys, onAnswer);
    if (refusal) return SearchEnd{*refusal};
    finder_.reset();
    return refusal.error();
  }

  Status send(const std::vector<SentInstance>& instances, const OnSent& onSent) override {
    finder_.reset();
    return sendByDimse(archive_, instances, onSent, cancel_);
  }

  // By C-GET, and what does not come so by C-MOVE.
  Status retrieve(const WantedInstances& wanted, InstanceSink& sink) override {
    finder_.reset();  // archives end what is idle
    const Status got = getAll(wanted, sink);
    WantedInstances rest = wanted;
    std::erase_if(rest.instances, [&](const ListedInstance& one) { return sink.has(one.uid); });
    if (rest.instances.empty() || cancel_.cancelled() || !archive_.listen) return got;
    rest.isWhole = wanted.isWhole && rest.instances.size() == wanted.instances.size();
    return moveFromArchive(archive_, rest, sink, cancel_);
  }

 private:
  Status getAll(const WantedInstances& wanted, InstanceSink& sink) {
    std::map<std::string, std::vector<std::string>> ofClass;
    for (const ListedInstance& one : wanted.instances) ofClass[one.sopClass].push_back(one.uid);
    std::vector<std::string> classes;
    for (const auto& [sopClass, uids] : ofClass) classes.push_back(sopClass);
    Status problem;
    for (std::size_t first = 0; first < classes.size(); first += mostClasses) {
      const std::size_t end = std::min(first + mostClasses, classes.size());
      std::vector<std::string> some(classes.begin() + std::ptrdiff_t(first),
                                    classes.begin() + std::ptrdiff_t(end));
      std::vector<std::string> uids;
      for (const std::string& sopClass : some)
        uids.insert(uids.end(), ofClass[sopClass].begin(), ofClass[sopClass].end());
      const Status s = retrieveClasses(wanted, std::move(some), std::move(uids), sink);
      if (!s) problem = s;
      if (cancel_.cancelled()) break;
    }
    return problem;
  }

  // What does not come is asked for once more with the next services.
  Status retrieveClasses(const WantedInstances& wanted, std::vector<std::string> classes,
                         std::vector<std::string> uids, InstanceSink& sink) {
    bool isWhole = wanted.isWhole && uids.size() == wanted.instances.size();
    const bool isGuessed = std::erase(classes, "") > 0;
    if (isGuessed)
      for (const std::string& usual : classesOf(wanted.modality)) classes.push_back(usual);
    std::vector<std::vector<WantedService>> tries{servicesFor(classes, false), servicesFor(classes, true)};
    if (isGuessed) tries.push_back(servicesForAny());
    Status last;
    for (const std::vector<WantedService>& services : tries) {
      auto association = Association::open(archive_, services, cancel_);
      last = association ? get(*association, wanted, uids, isWhole, sink) : Status(association.error());
      if (cancel_.cancelled()) return Error{"cancelled"};
      if (association && !association->offers(getModel)) return withoutGet();
      std::erase_if(uids, [&](const std::string& uid) { return sink.has(uid); });
      if (uids.empty()) return {};
      isWhole = false;
    }
    return last;
  }

  Error withoutGet() const {
    return {"The archive \"" + archive_.name + "\" offers no retrieval over one association (C-GET)" +
            (archive_.listen
                 ? "."
                 : ": add \"listen\" to the list of archives, so that it can send here (C-MOVE).")};
  }

  // Asks for a whole series at once, or by instance for what is missing.
  Status get(Association& association, const WantedInstances& wanted, const std::vector<std::string>& uids,
             bool isWhole, InstanceSink& sink) {
    for (DcmDataset& keys :
         keysForInstances(wanted.studyUid, wanted.seriesUid, isWhole ? std::vector<std::string>() : uids))
      if (Status s = ended(association.get(getModel, keys, sink)); !s) return s;
    return {};
  }

  const Archive archive_;
  const CancelToken cancel_;
  std::optional<Association> finder_;
};

}  // namespace

std::unique_ptr<ArchiveProtocol> makeDimseProtocol(const Archive& archive, const CancelToken& cancel) {
  return std::make_unique<DimseProtocol>(archive, cancel);
}

}  // namespace volumen
