#include "io/archive/fetch_archive.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcuid.h>

#include <QByteArray>
#include <QCryptographicHash>
#include <algorithm>
#include <map>
#include <set>

#include "io/archive/association.h"
#include "io/archive/data_sets.h"
#include "io/archive/instance_folder.h"
#include "io/files/private_folder.h"

namespace volumen {

namespace {

constexpr const char* findModel = UID_FINDStudyRootQueryRetrieveInformationModel;
constexpr const char* getModel = UID_GETStudyRootQueryRetrieveInformationModel;
constexpr std::size_t mostInstances = 200000;

// Transfer syntaxes in which instances are stored. In a list of several, archives choose an uncompressed one
// and convert what they hold; so each is offered alone.
const std::vector<std::string> storedSyntaxes{UID_JPEGLSLosslessTransferSyntax,
                                              UID_JPEGLSLossyTransferSyntax,
                                              UID_JPEG2000LosslessOnlyTransferSyntax,
                                              UID_JPEG2000TransferSyntax,
                                              UID_JPEGProcess14SV1TransferSyntax,
                                              UID_JPEGProcess14TransferSyntax,
                                              UID_JPEGProcess1TransferSyntax,
                                              UID_JPEGProcess2_4TransferSyntax,
                                              UID_RLELosslessTransferSyntax,
                                              UID_DeflatedExplicitVRLittleEndianTransferSyntax,
                                              UID_MPEG2MainProfileAtMainLevelTransferSyntax,
                                              UID_MPEG2MainProfileAtHighLevelTransferSyntax,
                                              UID_MPEG4HighProfileLevel4_1TransferSyntax,
                                              UID_LittleEndianExplicitTransferSyntax,
                                              UID_BigEndianExplicitTransferSyntax,
                                              UID_LittleEndianImplicitTransferSyntax};

// One context for the model and one for each class and syntax; there are 128.
constexpr std::size_t mostClasses = 7;

struct ListedInstance {
  std::string uid;
  std::string sopClass;  // empty if the archive does not tell
};

struct ListedSeries {
  std::string modality;
  std::vector<ListedInstance> instances;
};

using SeriesByUid = std::map<std::string, ListedSeries>;

// Returns a refusal as an Error, too.
Status ended(const Result<std::string>& refusal) {
  if (!refusal) return refusal.error();
  return refusal->empty() ? Status() : Error{*refusal};
}

// Returns the series of a study with their instances, as the archive lists them.
class Listing {
 public:
  Listing(Association& association, const Archive& archive, const FetchRequest& request)
      : association_(association), archive_(archive), request_(request) {}

  Result<SeriesByUid> operator()() {
    SeriesByUid all;
    DcmDataset keys = keysAt("SERIES", request_.studyUid);
    putKey(keys, DCM_SeriesInstanceUID, request_.seriesUid);
    askFor(keys, {DCM_Modality});
    const Status listed = list(keys, [&](const Answer& answer) {
      const std::string uid = answer.text(DCM_SeriesInstanceUID);
      const bool isWanted = isOf(answer, DCM_StudyInstanceUID, request_.studyUid) &&
                            (request_.seriesUid.empty() || uid == request_.seriesUid);
      if (!uid.empty() && isWanted) all[uid].modality = answer.text(DCM_Modality);
      return all.size() < mostInstances;
    });
    if (!listed) return listed.error();
    for (auto& [uid, series] : all)
      if (Status s = addInstances(uid, series.instances); !s) return s.error();
    std::erase_if(all, [](const auto& series) { return series.second.instances.empty(); });
    return all;
  }

 private:
  // An archive that ignores a key answers with others, too.
  static bool isOf(const Answer& answer, const DcmTagKey& tag, const std::string& uid) {
    const std::string of = answer.text(tag);
    return of.empty() || of == uid;
  }

  Status addInstances(const std::string& seriesUid, std::vector<ListedInstance>& instances) {
    DcmDataset keys = keysAt("IMAGE", request_.studyUid);
    putKey(keys, DCM_SeriesInstanceUID, seriesUid);
    askFor(keys, {DCM_SOPInstanceUID, DCM_SOPClassUID});
    std::set<std::string> known;
    return list(keys, [&](const Answer& answer) {
      ListedInstance one{answer.text(DCM_SOPInstanceUID), answer.text(DCM_SOPClassUID)};
      if (!one.uid.empty() && isOf(answer, DCM_SeriesInstanceUID, seriesUid) && known.insert(one.uid).second)
        instances.push_back(std::move(one));
      return instances.size() < mostInstances;
    });
  }

  // The Error: a list that the archive ends early would count too few.
  Status list(DcmDataset& keys, const std::function<bool(const Answer&)>& onAnswer) {
    return ended(association_.find(
        findModel, keys, [&](DcmDataset& data) { return onAnswer(Answer(data, archive_.characterSet)); }));
  }

  Association& association_;
  const Archive& archive_;
  const FetchRequest& request_;
};

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

// Fetches the series of one study, one after the other.
class Fetch {
 public:
  Fetch(const Archive& archive, const FetchRequest& request, const Progress& progress,
        const CancelToken& cancel)
      : archive_(archive), request_(request), progress_(progress), cancel_(cancel) {}

  Result<FetchReport> operator()(const SeriesByUid& all) {
    for (const auto& [uid, series] : all) report_.expected += int(series.instances.size());
    for (const auto& [uid, series] : all)
      if (Status s = fetchSeries(uid, series); !s) return s.error();
    if (report_.fetched + report_.alreadyHere == 0 && !report_.problems.empty())
      return Error{report_.problems.front()};
    return report_;
  }

 private:
  // The Error: this computer cannot go on.
  Status fetchSeries(const std::string& seriesUid, const ListedSeries& series) {
    const std::string folder = request_.folder + "/" + nameForUid(seriesUid);
    if (Status s = makePrivateFolder(folder); !s) return s;
    InstanceFolder files(folder, [&] {
      if (progress_) progress_("fetching", ++stored_, std::size_t(report_.expected));
    });
    std::map<std::string, std::vector<std::string>> wanted;  // of each class
    std::size_t here = 0;
    for (const ListedInstance& one : series.instances)
      files.has(one.uid) ? void(++here) : wanted[one.sopClass].push_back(one.uid);
    report_.alreadyHere += int(here);
    std::vector<std::string> classes;
    for (const auto& [sopClass, uids] : wanted) classes.push_back(sopClass);
    for (std::size_t first = 0; first < classes.size(); first += mostClasses) {
      const auto begin = classes.begin() + std::ptrdiff_t(first);
      const std::vector<std::string> some(
          begin, begin + std::ptrdiff_t(std::min(mostClasses, classes.size() - first)));
      std::vector<std::string> uids;
      for (const std::string& sopClass : some)
        uids.insert(uids.end(), wanted[sopClass].begin(), wanted[sopClass].end());
      const bool isWhole = uids.size() == series.instances.size();
      std::vector<std::string> offered = some;
      const bool isGuessed = std::erase(offered, "") > 0;
      if (isGuessed)
        for (const std::string& usual : classesOf(series.modality)) offered.push_back(usual);
      std::vector<std::vector<WantedService>> tries{servicesFor(offered, false), servicesFor(offered, true)};
      if (isGuessed) tries.push_back(servicesForAny());
      if (Status s = fetchInstances(seriesUid, tries, uids, isWhole, files); !s) return s;
    }
    for (const auto& [sopClass, uids] : wanted)
      for (const std::string& uid : uids)
        files.has(uid) ? void(++report_.fetched) : report_.missing.push_back(uid);
    report_.bytes += files.bytesWritten();
    return {};
  }

  // Asks for a whole series at once, or by instance for what is missing. What does not come is asked for once
  // more with the next services.
  Status fetchInstances(const std::string& seriesUid, const std::vector<std::vector<WantedService>>& tries,
                        std::vector<std::string> uids, bool isWhole, InstanceFolder& files) {
    Status last;
    for (const std::vector<WantedService>& services : tries) {
      auto association = Association::open(archive_, services, cancel_);
      last =
          association ? retrieve(*association, seriesUid, uids, isWhole, files) : Status(association.error());
      if (cancel_.cancelled()) return Error{"cancelled"};
      std::erase_if(uids, [&](const std::string& uid) { return files.has(uid); });
      if (uids.empty()) return {};
      isWhole = false;
    }
    addProblem(last ? "The archive \"" + archive_.name + "\" did not send all that it lists."
                    : last.message());
    return {};
  }

  Status retrieve(Association& association, const std::string& seriesUid,
                  const std::vector<std::string>& uids, bool isWhole, InstanceFolder& files) {
    if (isWhole) {
      DcmDataset keys = keysAt("SERIES", request_.studyUid);
      putKey(keys, DCM_SeriesInstanceUID, seriesUid);
      return ended(association.get(getModel, keys, files));
    }
    constexpr std::size_t atOnce = 100;
    for (std::size_t first = 0; first < uids.size(); first += atOnce) {
      std::string list;
      for (std::size_t n = first; n < std::min(uids.size(), first + atOnce); ++n)
        list += (list.empty() ? "" : "\\") + uids[n];
      DcmDataset keys = keysAt("IMAGE", request_.studyUid);
      putKey(keys, DCM_SeriesInstanceUID, seriesUid);
      putKey(keys, DCM_SOPInstanceUID, list);
      if (Status s = ended(association.get(getModel, keys, files)); !s) return s;
    }
    return {};
  }

  void addProblem(const std::string& sentence) {
    if (std::ranges::find(report_.problems, sentence) == report_.problems.end())
      report_.problems.push_back(sentence);
  }

  const Archive& archive_;
  const FetchRequest& request_;
  const Progress& progress_;
  const CancelToken& cancel_;
  FetchReport report_;
  std::size_t stored_ = 0;
};

}  // namespace

std::string nameForUid(const std::string& uid) {
  const QByteArray hash =
      QCryptographicHash::hash(QByteArray::fromStdString(uid), QCryptographicHash::Sha256);
  return hash.toHex().left(32).toStdString();
}

Result<FetchReport> fetchFromArchive(const Archive& archive, const FetchRequest& request,
                                     const Progress& progress, const CancelToken& cancel) {
  Result<SeriesByUid> series = Error{};
  {
    auto association = Association::open(archive, {plainService(findModel)}, cancel);
    if (!association) return association.error();
    series = Listing(*association, archive, request)();
  }
  if (!series) return series.error();
  if (series->empty())
    return Error{"The archive \"" + archive.name + "\" lists no images of this " +
                 (request.seriesUid.empty() ? "study." : "series.")};
  return Fetch(archive, request, progress, cancel)(*series);
}

}  // namespace volumen
