#include "ui/views/latin_key.h"

#include <QLatin1String>

namespace volumen {

namespace {

// The three letter rows of a keyboard, from the first scan code on X11 and Wayland (evdev code + 8).
struct KeyRow {
  quint32 first;
  QLatin1String keys;
};
constexpr KeyRow keyRows[] = {{24, QLatin1String("QWERTYUIOP[]")},
                              {38, QLatin1String("ASDFGHJKL;'")},
                              {52, QLatin1String("ZXCVBNM,./")}};

bool isForeignLetter(int key) {
  if (key < 0x80 || key > 0xffff) return false;
  const QChar letter{char16_t(key)};
  return letter.isLetter() && letter.script() != QChar::Script_Latin;
}

}  // namespace

int latinKey(const QKeyEvent& event) {
  if (!isForeignLetter(event.key())) return event.key();
  for (const KeyRow& row : keyRows) {
    const quint32 code = event.nativeScanCode();
    if (code >= row.first && code < row.first + quint32(row.keys.size()))
      return row.keys[qsizetype(code - row.first)].unicode();
  }
  return event.key();
}

}  // namespace volumen
