#include "io/archive/send_web.h"

#include <QFile>
#include <QHttpMultiPart>
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "io/archive/answer_text.h"

namespace volumen {

namespace {

using Json = nlohmann::json;

constexpr std::uintmax_t mostBytesAtOnce = 32 << 20;  // unless one instance alone is larger
constexpr std::size_t mostAtOnce = 50;

// Returns the first value of an attribute; null if there is none.
Json firstValue(const Json& item, const char* tag) {
  const auto found = item.is_object() ? item.find(tag) : item.end();
  if (!item.is_object() || found == item.end() || !found->is_object()) return {};
  const auto value = found->find("Value");
  return value != found->end() && value->is_array() && !value->empty() ? value->front() : Json();
}

// Calls `visit` for the items of a sequence with the UID that each refers to.
void forEachReferred(const Json& answer, const char* tag,
                     const std::function<void(const Json& item, const std::string& uid)>& visit) {
  const auto found = answer.find(tag);
  if (found == answer.end() || !found->is_object() || !found->contains("Value") ||
      !(*found)["Value"].is_array())
    return;
  for (const Json& item : (*found)["Value"])
    if (const Json uid = firstValue(item, "00081155"); uid.is_string()) visit(item, uid.get<std::string>());
}

std::unique_ptr<QHttpMultiPart> partsOf(const std::vector<SentInstance>& instances, std::size_t first,
                                        std::size_t end) {
  auto all = std::make_unique<QHttpMultiPart>(QHttpMultiPart::RelatedType);
  for (std::size_t n = first; n < end; ++n) {
    auto* file = new QFile(QFile::decodeName(instances[n].path.c_str()), all.get());
    if (!file->open(QFile::ReadOnly)) continue;  // its absence from the answer is told
    QHttpPart part;
    part.setHeader(QNetworkRequest::ContentTypeHeader, QByteArray("application/dicom"));
    part.setBodyDevice(file);
    all->append(part);
  }
  return all;
}

class Stow {
 public:
  Stow(WebExchange& exchange, const std::vector<SentInstance>& instances, const OnSent& onSent)
      : exchange_(exchange), instances_(instances), onSent_(onSent) {}

  Status operator()() {
    for (std::size_t first = 0; first < instances_.size();) {
      const std::size_t end = endOf(first);
      AnswerText body(exchange_);
      const auto answer = exchange_.send(
          {"/studies", "application/dicom+json", [&, this] { return partsOf(instances_, first, end); }},
          body.onBody());
      if (!answer) return answer.error();
      // One of many may be what it cannot take.
      const bool isRefused = answer->status == 413 || answer->status == 400 || answer->status >= 500;
      if (isRefused && end - first > 1) {
        atOnce_ = (end - first) / 2;
        continue;
      }
      tell(*answer, body.text(), first, end);
      first = end;
    }
    return {};
  }

 private:
  std::size_t endOf(std::size_t first) const {
    std::size_t end = first;
    for (std::uintmax_t bytes = 0; end < instances_.size() && end - first < atOnce_; ++end) {
      std::error_code ignored;
      bytes += std::filesystem::file_size(instances_[end].path, ignored);
      if (bytes > mostBytesAtOnce && end > first) break;
    }
    return end;
  }

  void tell(const WebAnswer& answer, const std::string& text, std::size_t first, std::size_t end) const {
    const Json json = Json::parse(text.empty() ? "{}" : text, nullptr, false);
    std::set<std::string> kept;
    std::map<std::string, std::string> refused;
    if (json.is_object()) {
      forEachReferred(json, "00081199", [&](const Json&, const std::string& uid) { kept.insert(uid); });
      forEachReferred(json, "00081198", [&](const Json& item, const std::string& uid) {
        const Json reason = firstValue(item, "00081197");
        refused[uid] = exchange_.says("refuses it" + reasonText(reason)).message;
      });
    }
    for (std::size_t n = first; n < end; ++n) {
      const std::string& uid = instances_[n].uids.instance;
      const auto why = refused.find(uid);
      if (why != refused.end())
        onSent_(n, why->second);
      else if (kept.count(uid))
        onSent_(n, "");
      else
        onSent_(n, exchange_
                       .says(answer.status == 413 ? "refuses it as too large (413)"
                                                  : "does not say that it keeps it (status " +
                                                        std::to_string(answer.status) + ")")
                       .message);
    }
  }

  // Failure Reason (PS3.18 I.2, PS3.3 C.14.1.1).
  static std::string reasonText(const Json& reason) {
    if (!reason.is_number_integer()) return "";
    const auto code = reason.get<std::int64_t>();
    if (code == 0x0122) return ": it does not keep this class";
    if (code == 0xa700) return ": it has no room";
    if (code == 45070) return ": it has an image of this UID already, which may differ (reason 45070)";
    if (code == 0x0110) return ": it could not process it (reason 272)";
    return " with reason " + std::to_string(code);
  }

  WebExchange& exchange_;
  const std::vector<SentInstance>& instances_;
  const OnSent& onSent_;
  std::size_t atOnce_ = mostAtOnce;
};

}  // namespace

Status sendByWeb(WebExchange& exchange, const std::vector<SentInstance>& instances, const OnSent& onSent) {
  return Stow(exchange, instances, onSent)();
}

}  // namespace volumen
