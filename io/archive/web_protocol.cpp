// Archives that are asked by DICOMweb (PS3.18): QIDO-RS, WADO-RS and STOW-RS.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcdeftag.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "io/archive/answer_text.h"
#include "io/archive/data_sets.h"
#include "io/archive/multipart.h"
#include "io/archive/protocol.h"
#include "io/archive/send_web.h"
#include "io/archive/web_exchange.h"
#include "io/archive/web_json.h"
#include "io/dicom/instance_uids.h"
#include "io/worker/call.h"

namespace volumen {

namespace {

constexpr const char* jsonType = "application/dicom+json";

// Writes the instances that come into a sink. Those that nobody asked for are dropped.
class InstanceParts : public PartSink {
 public:
  explicit InstanceParts(InstanceSink& sink) : sink_(sink) {}
  ~InstanceParts() override {
    if (file_.is_open()) sink_.drop();
  }

  Status beginPart() override {
    if (file_.is_open()) file_.close();  // the last one was cut off
    auto path = sink_.begin();
    if (!path) return path.error();
    path_ = *path;
    file_.open(path_, std::ios::binary | std::ios::trunc);
    return file_ ? Status() : cannotWrite();
  }

  Status partData(std::string_view bytes) override {
    file_.write(bytes.data(), std::streamsize(bytes.size()));
    return file_ ? Status() : cannotWrite();
  }

  Status endPart() override {
    file_.close();
    if (!file_) return cannotWrite();
    // Archives may send more of a series than they list; what is not of it is dropped.
    const auto uids = dicom::instanceUids(path_);
    if (uids) return sink_.end(*uids);
    sink_.drop();
    return worker::isReasonOfMachine(uids.message())
               ? Error{"An image that came cannot be read: " + uids.message() + "."}
               : Status();
  }

 private:
  Status cannotWrite() {
    file_.close();
    sink_.drop();
    return cannotWriteInto(path_);
  }

  InstanceSink& sink_;
  std::string path_;
  std::ofstream file_;
};

// Takes the body of an answer of WADO-RS: parts, or one instance without parts.
class WadoBody {
 public:
  WadoBody(InstanceParts& parts, const WebExchange& exchange) : parts_(parts), exchange_(exchange) {}

  WebExchange::OnBody onBody() {
    return [this](const WebAnswer& answer, std::string_view bytes) { return take(answer, bytes); };
  }

  // Call it after the last byte. A part that is cut off stays out.
  Status end() {
    if (isOne_ && !isMeasured_) return exchange_.says("does not say where an instance ends");
    if (isOne_) return parts_.endPart();
    if (reader_ && !reader_->isComplete()) return exchange_.says("ended the answer too early");
    return {};
  }

 private:
  Status take(const WebAnswer& answer, std::string_view bytes) {
    if (!reader_ && !isOne_) {
      auto reader = MultipartReader::of(answer.contentType, parts_);
      if (reader) {
        reader_.emplace(std::move(*reader));
      } else {
        if (!answer.contentType.starts_with("application/dicom"))
          return exchange_.says("sends " + reader.message());
        isOne_ = true;
        isMeasured_ = answer.isMeasured;
        if (Status s = parts_.beginPart(); !s) return s;
      }
    }
    if (isOne_) return parts_.partData(bytes);
    const Status fed = reader_->feed(bytes);
    return reader_->isBroken() ? exchange_.says("sends " + fed.message()) : fed;
  }

  InstanceParts& parts_;
  const WebExchange& exchange_;
  std::optional<MultipartReader> reader_;
  bool isOne_ = false, isMeasured_ = false;
};

// Media types for instances, as stored if possible. Archives refuse lists of types, and some of these.
constexpr const char* wadoTypes[] = {
    "multipart/related; type=\"application/dicom\"; transfer-syntax=*",
    "application/dicom; transfer-syntax=*",
    "multipart/related; type=\"application/dicom\"",
    "application/dicom",
};

// Calls visit(text, most values in it) for each object in a list, which is valid JSON, until it returns
// false. Returns what it returned last.
template <class Visit>
bool forEachObject(std::string_view list, Visit visit) {
  int depth = 0;
  std::size_t begin = 0, values = 0;
  for (std::size_t at = 0; at < list.size(); ++at) {
    const char c = list[at];
    if (c == '"') {
      while (list[++at] != '"') at += list[at] == '\\';
    } else if (c == '{' || c == '[') {
      if (depth++ == 1) begin = at, values = 0;
      ++values;
    } else if (c == '}' || c == ']') {
      if (--depth == 1 && c == '}' && !visit(list.substr(begin, at + 1 - begin), values)) return false;
    } else {
      values += c == ',' || c == ':';
    }
  }
  return true;
}

class WebProtocol : public ArchiveProtocol {
 public:
  WebProtocol(const Archive& archive, const CancelToken& cancel)
      : exchange_(archive, cancel), cancel_(cancel) {}

  Status test() override {
    AnswerText body(exchange_);
    const auto answer = exchange_.send({"/studies?limit=1", jsonType, {}}, body.onBody());
    if (!answer) return answer.error();
    return isSuccess(*answer) ? Status() : refusal(*answer);
  }

  // Some archives compare names without wildcards, but fuzzily.
  Result<SearchEnd> find(DcmDataset& keys, const std::function<bool(DcmDataset&)>& onAnswer) override {
    std::set<std::string> known;
    const auto found = findPages(keys, false, known, onAnswer);
    const bool isOfName = isOfStudies(keys) && !Answer(keys, "").text(DCM_PatientName).empty();
    return found && found->early.empty() && known.empty() && isOfName ? findPages(keys, true, known, onAnswer)
                                                                      : found;
  }

  Status send(const std::vector<SentInstance>& instances, const OnSent& onSent) override {
    return sendByWeb(exchange_, instances, onSent);
  }

  Status retrieve(const WantedInstances& wanted, InstanceSink& sink) override {
    InstanceParts parts(sink);
    const std::string series =
        "/studies/" + percentEncoded(wanted.studyUid) + "/series/" + percentEncoded(wanted.seriesUid);
    Status problem;
    if (wanted.isWhole && wanted.instances.size() > 1) {
      bool isRefused = false;
      problem = get(series, wadoTypes[0], parts, isRefused);
    }
    for (const ListedInstance& one : wanted.instances) {
      if (sink.has(one.uid)) continue;
      if (cancel_.cancelled()) return Error{"cancelled"};
      const Status s = getInstance(series + "/instances/" + percentEncoded(one.uid), parts);
      if (!s) problem = s;
      if (failures_ == mostFailures) break;
    }
    return problem;
  }

 private:
  static constexpr int mostFailures = 3;
  static constexpr std::size_t pageSize = 200;  // more are refused by some

  static bool isSuccess(const WebAnswer& answer) { return answer.status >= 200 && answer.status < 300; }
  static bool isOfStudies(DcmDataset& keys) {
    return Answer(keys, "").text(DCM_QueryRetrieveLevel) == "STUDY";
  }

  // Archives have page sizes of their own, and some know no pages: the last page brings nothing new.
  Result<SearchEnd> findPages(DcmDataset& keys, bool isFuzzy, std::set<std::string>& known,
                              const std::function<bool(DcmDataset&)>& onAnswer) {
    bool hasMore = false;
    for (int offset = 0;;) {
      AnswerText body(exchange_);
      const auto answer =
          exchange_.send({searchTarget(keys, int(pageSize), offset, isFuzzy), jsonType, {}}, body.onBody());
      if (!answer) return answer.error();
      if (answer->status == 404 && offset == 0 && !isOfStudies(keys)) return SearchEnd();
      if (!isSuccess(*answer)) return SearchEnd{refusal(*answer).message};
      if (!isPage(body.text()))
        return SearchEnd{exchange_.says("does not answer the search in JSON").message};
      const std::size_t before = known.size();
      std::size_t answers = 0;
      const bool isMoreWanted = givePage(body.text(), keys, known, onAnswer, answers);
      if (cancel_.cancelled()) return Error{"cancelled"};
      if (!isMoreWanted) return SearchEnd();
      // An archive that knows no pages sends the first again; a round number of answers is a limit of its
      // own.
      const bool isCapped = isOfStudies(keys) && answers > 0 && answers < pageSize && answers % 50 == 0;
      if (known.size() == before)
        return hasMore || isCapped
                   ? SearchEnd{exchange_.says("may have more than it sends: add a word or a date").message,
                               true}
                   : SearchEnd();
      hasMore = answer->isPart || answer->status == 206;
      offset += int(answers);
    }
  }

  Error refusal(const WebAnswer& answer) const {
    if (answer.status == 404) return exchange_.says("has no DICOMweb services at this URL (404)");
    if (answer.status == 429 || answer.status >= 500)
      return exchange_.says("is out of order, or busy (" + std::to_string(answer.status) + ")");
    if (answer.status == 413)
      return exchange_.says("refuses the search as too large (413): add a word or a date");
    return exchange_.says("answers with status " + std::to_string(answer.status));
  }

  static bool isPage(const std::string& text) {
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    return first == std::string::npos || (text[first] == '[' && nlohmann::json::accept(text));
  }

  // Only one answer is in memory at a time: in numbers and braces of two bytes each, 32 MB of text would take
  // gigabytes. Returns whether more is wanted.
  bool givePage(const std::string& text, DcmDataset& keys, std::set<std::string>& known,
                const std::function<bool(DcmDataset&)>& onAnswer, std::size_t& answers) const {
    constexpr std::size_t mostAnswers = 200000, mostValues = 20000;
    return forEachObject(text, [&](std::string_view one, std::size_t values) {
      if (++answers > mostAnswers || values > mostValues) return true;
      return !cancel_.cancelled() &&
             giveAnswer(nlohmann::json::parse(one, nullptr, false), keys, known, onAnswer);
    });
  }

  static bool giveAnswer(const nlohmann::json& one, DcmDataset& keys, std::set<std::string>& known,
                         const std::function<bool(DcmDataset&)>& onAnswer) {
    constexpr std::size_t mostLetters = 64;  // of a UID (PS3.5 9.1)
    DcmDataset data;
    putAnswer(one, keys, data);
    const Answer answer(data, "");
    std::string uid;
    for (const DcmTagKey& tag : {DCM_SOPInstanceUID, DCM_SeriesInstanceUID, DCM_StudyInstanceUID})
      if (uid.empty()) uid = answer.text(tag);
    return uid.size() > mostLetters || !known.insert(uid).second || onAnswer(data);
  }

  // Some archives refuse a type that others need; what one accepts is asked for from then on.
  Status getInstance(const std::string& target, InstanceParts& parts) {
    for (; type_ < std::size(wadoTypes); ++type_) {
      bool isRefused = false;
      const Status s = get(target, wadoTypes[type_], parts, isRefused);
      if (!isRefused) return s;
    }
    type_ = 0;
    return exchange_.says("sends instances in none of the forms that are asked for (406)");
  }

  Status get(const std::string& target, const char* type, InstanceParts& parts, bool& isRefused) {
    WadoBody body(parts, exchange_);
    const auto answer = exchange_.send({target, type, {}, false}, body.onBody());
    failures_ = !answer || answer->status == 429 || answer->status >= 500 ? failures_ + 1 : 0;
    if (!answer) return answer.error();
    isRefused = answer->status == 400 || answer->status == 406 || answer->status == 415;
    if (isRefused) return {};
    if (answer->status == 404 || answer->status == 410)
      return exchange_.says("no longer has all that it lists");
    if (!isSuccess(*answer)) return refusal(*answer);
    return body.end();
  }

  WebExchange exchange_;
  const CancelToken cancel_;
  std::size_t type_ = 0;  // in wadoTypes
  int failures_ = 0;      // of retrievals, one after the other
};

}  // namespace

std::unique_ptr<ArchiveProtocol> makeWebProtocol(const Archive& archive, const CancelToken& cancel) {
  return std::make_unique<WebProtocol>(archive, cancel);
}

}  // namespace volumen
