#include "results/series/series_facts.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace volumen {

namespace {

char lowered(char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; }

std::string loweredText(std::string text) {
  std::ranges::transform(text, text.begin(), lowered);
  return text;
}

// Bytes of UTF-8 beyond ASCII count as letters.
bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (static_cast<unsigned char>(c) & 0x80); }

std::vector<std::string> alternativesOf(const std::string& text) {
  std::vector<std::string> all(1);
  for (const char c : text)
    if (c == '|')
      all.emplace_back();
    else
      all.back() += lowered(c);
  std::erase(all, std::string());
  return all;
}

bool isDigit(char c) { return c >= '0' && c <= '9'; }

// The word must begin a word, and no number may continue it: "t1" is not in "T10-L2". "=fs" is a whole word.
bool saysWord(const std::string& text, std::string word) {
  const bool isWhole = word.size() > 1 && word[0] == '=';
  if (isWhole) word.erase(0, 1);
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    const bool begins = at == 0 || !isLetter(text[at - 1]) || !isLetter(word[0]);
    const bool goesOn = end < text.size() && (isDigit(text[end]) ? isWhole || isDigit(word.back())
                                                                 : isWhole && isLetter(text[end]));
    if (begins && !goesOn) return true;
  }
  return false;
}

const std::string& valueOfSplit(const Series& series, const char* attribute) {
  static const std::string none;
  const auto found = std::ranges::find(series.splitBy, attribute, &SplitBy::attribute);
  return found == series.splitBy.end() ? none : found->value;
}

// Returns whether it says "T1 +C" or "T1+C SAG".
bool saysPlusC(const std::string& description) {
  const std::string said = loweredText(description);
  const std::size_t at = said.find("+c");
  return at != std::string::npos && (at + 2 == said.size() || !isLetter(said[at + 2]));
}

// Returns whether the text names an agent: some files write that there was none.
bool isAgent(const std::string& agent) {
  return !agent.empty() && !isOneOf(agent, "none|no|nil|no contrast");
}

// Siemens numbers its kernels by sharpness: "B70f", "Br40d", "I31f".
int sharpnessOf(const std::string& kernel) {
  const std::size_t digit = kernel.find_first_of("0123456789");
  return digit == std::string::npos || digit > 2 ? 0 : std::atoi(kernel.c_str() + digit);
}

}  // namespace

bool hasWord(const std::string& text, const std::string& alternatives) {
  const std::string in = loweredText(text);
  return std::ranges::any_of(alternativesOf(alternatives),
                             [&](const std::string& word) { return saysWord(in, word); });
}

bool isOneOf(const std::string& text, const std::string& alternatives) {
  const std::vector<std::string> all = alternativesOf(alternatives);
  return std::ranges::find(all, loweredText(text)) != all.end();
}

std::vector<std::string> wordsOf(const std::string& text) {
  std::vector<std::string> words(1);
  for (const char c : loweredText(text))
    if (isLetter(c) || (c >= '0' && c <= '9'))
      words.back() += c;
    else if (!words.back().empty())
      words.emplace_back();
  std::erase(words, std::string());
  return words;
}

std::optional<Weighting> weightingOf(const Series& series) {
  const std::string& said = series.description;
  if (hasWord(said, "adc")) return Weighting::adc;
  const bool isWeighted = !series.bValue.empty() && std::atof(series.bValue.c_str()) > 0;
  if (isWeighted || hasWord(said, "dwi|diff|trace|ep2d_diff")) return Weighting::diffusion;
  const std::pair<const char*, Weighting> table[] = {
      {"tof|mra|angio", Weighting::angiography},
      {"swi|swan|t2*|t2star|hemo|medic", Weighting::t2Star},
      {"t1|mprage|mp2rage|bravo|spgr|vibe|lava", Weighting::t1},  // "T1 FLAIR" is T1-weighted
      {"flair|tirm|dark", Weighting::flair},
      {"t2", Weighting::t2},
      {"pd|proton", Weighting::protonDensity}};
  for (const auto& [words, weighting] : table)
    if (hasWord(said, words)) return weighting;
  return {};
}

std::optional<Kernel> kernelOf(const Series& series) {
  const std::string& kernel = valueOfSplit(series, "ConvolutionKernel");
  const std::string said = series.description + " " + kernel;
  if (hasWord(said, "lung|poumon")) return Kernel::lung;
  if (hasWord(said, "bone|knochen|skeleton")) return Kernel::bone;
  if (hasWord(said, "soft|weichteil|standard|stnd|mediast|brain|abdomen")) return Kernel::soft;
  constexpr int leastSharp = 60;
  if (const int sharpness = sharpnessOf(kernel)) return sharpness >= leastSharp ? Kernel::bone : Kernel::soft;
  return {};
}

std::optional<bool> contrastOf(const Series& series) {
  const std::string& said = series.description;
  // Whole words, so that "presat", "novel" and "posterior" do not match.
  if (hasWord(said, "native|unenhanced|w/o|=pre|=wo|=no|=non|=without|=ohne|=vor|=kein|=keine|=nativ"))
    return false;
  if (saysPlusC(said) || hasWord(said, "gadolinium|contrast|enhanced|=gd|=gad|=post|=km|=ce") ||
      isAgent(valueOfSplit(series, "ContrastBolusAgent")))
    return true;
  return {};
}

bool namesContrast(const Series& series) {
  return isAgent(series.contrastAgent) || contrastOf(series).value_or(false);
}

bool areOfOnePatient(const SeriesIdentity& a, const SeriesIdentity& b) {
  return a.patientId == b.patientId && a.patientName == b.patientName;
}

const VoxelGeometry& drawnGeometry(const Series& series) {
  return series.regular ? series.regular->geometry : series.acquired;
}

}  // namespace volumen
