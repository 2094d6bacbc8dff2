#pragma once

#include <chrono>
#include <string>

#include "io/archive/web_exchange.h"

namespace volumen {

/// Collects the body of an answer as text. The body may have 32 MB and take 2 minutes.
class AnswerText {
 public:
  explicit AnswerText(const WebExchange& exchange) : exchange_(exchange) {}

  WebExchange::OnBody onBody() {
    return [this](const WebAnswer&, std::string_view bytes) -> Status {
      if (text_.empty()) end_ = Clock::now() + std::chrono::minutes(2);
      if (text_.size() + bytes.size() > mostBytes) return exchange_.says("sent an answer that is too large");
      if (Clock::now() > end_) return exchange_.says("takes more than 2 minutes for an answer");
      text_ += bytes;
      return {};
    };
  }
  /// Returns the text received so far.
  const std::string& text() const { return text_; }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::size_t mostBytes = 32 << 20;

  const WebExchange& exchange_;
  Clock::time_point end_;
  std::string text_;
};

}  // namespace volumen
