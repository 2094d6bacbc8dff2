#include "app/batch/shell_words.h"

namespace volumen {

namespace {

// Splits a text. A word may be empty, if it is quoted.
class ShellWords {
 public:
  explicit ShellWords(std::string_view text) : rest_(text) {}

  Result<std::vector<std::string>> all() {
    while (!rest_.empty())
      if (Status s = takePart(); !s) return s.error();
    endWord();
    return std::move(words_);
  }

 private:
  char take() {
    const char c = rest_.front();
    rest_.remove_prefix(1);
    return c;
  }

  Status takePart() {
    const char c = take();
    if (c == ' ' || c == '\t' || c == '\n') {
      endWord();
      return {};
    }
    if (c == '\\') return takeEscaped();
    isWord_ = true;
    if (c == '\'') return takeSingleQuoted();
    if (c == '"') return takeDoubleQuoted();
    word_ += c;
    return {};
  }

  // A line end behind a backslash is nothing.
  Status takeEscaped() {
    if (rest_.empty()) return Error{"nothing follows its last backslash"};
    const char c = take();
    if (c == '\n') return {};
    isWord_ = true;
    word_ += c;
    return {};
  }

  Status takeSingleQuoted() {
    const std::size_t end = rest_.find('\'');
    if (end == rest_.npos) return Error{"a single quote is not closed"};
    word_ += rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    return {};
  }

  // A backslash before any other character stands for itself.
  Status takeDoubleQuoted() {
    constexpr std::string_view escapable = "$`\"\\\n";
    while (!rest_.empty()) {
      const char c = take();
      if (c == '"') return {};
      if (c != '\\' || rest_.empty() || escapable.find(rest_.front()) == escapable.npos)
        word_ += c;
      else if (const char escaped = take(); escaped != '\n')
        word_ += escaped;
    }
    return Error{"a double quote is not closed"};
  }

  void endWord() {
    if (isWord_) words_.push_back(std::move(word_));
    word_.clear();
    isWord_ = false;
  }

  std::string_view rest_;
  std::string word_;
  bool isWord_ = false;
  std::vector<std::string> words_;
};

}  // namespace

Result<std::vector<std::string>> shellWords(std::string_view text) { return ShellWords(text).all(); }

}  // namespace volumen
