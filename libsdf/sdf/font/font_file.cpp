#include "sdf/font/font_file.h"

#include <fontconfig/fontconfig.h>

#include <algorithm>
#include <memory>
#include <string_view>

#include "sdf/base/file.h"

namespace sdf {
namespace {

using Pattern = std::unique_ptr<FcPattern, decltype(&FcPatternDestroy)>;

// The machine's fonts as they are at the first call. Fontconfig's own is never given back.
FcConfig* fonts() {
  static const std::unique_ptr<FcConfig, decltype(&FcConfigDestroy)> config(FcInitLoadConfigAndFonts(),
                                                                            FcConfigDestroy);
  return config.get();
}

std::string textOf(const FcChar8* text) { return reinterpret_cast<const char*>(text); }

// Fontconfig takes another family where there is none of the name.
bool hasFamily(FcPattern* font, const FcChar8* family) {
  FcChar8* name = nullptr;
  for (int i = 0; FcPatternGetString(font, FC_FAMILY, i, &name) == FcResultMatch; ++i)
    if (FcStrCmpIgnoreCase(name, family) == 0) return true;
  return false;
}

}  // namespace

bool isFontFile(const std::string& name) {
  constexpr std::string_view kKnown[] = {".ttf", ".otf", ".ttc", ".otc", ".woff", ".woff2"};
  return std::ranges::find(kKnown, lowerExtension(name)) != std::end(kKnown);
}

Result<FontFile> findFont(const std::string& family) {
  const Error notFound{ErrorKind::Files,
                       "this machine has no font '" + family +
                           "'; name one that fc-list shows, or a font's file, or install it"};
  const Pattern wanted(FcNameParse(reinterpret_cast<const FcChar8*>(family.c_str())), FcPatternDestroy);
  FcChar8* name = nullptr;
  if (!wanted || FcPatternGetString(wanted.get(), FC_FAMILY, 0, &name) != FcResultMatch) return notFound;
  const std::string asked = textOf(name);
  FcPatternAddBool(wanted.get(), FC_SCALABLE, FcTrue);
  FcConfigSubstitute(fonts(), wanted.get(), FcMatchPattern);
  FcDefaultSubstitute(wanted.get());
  FcResult result = FcResultNoMatch;
  const Pattern font(FcFontMatch(fonts(), wanted.get(), &result), FcPatternDestroy);
  FcChar8* file = nullptr;
  if (!font || FcPatternGetString(font.get(), FC_FILE, 0, &file) != FcResultMatch ||
      !hasFamily(font.get(), reinterpret_cast<const FcChar8*>(asked.c_str())))
    return notFound;
  int index = 0;
  FcPatternGetInteger(font.get(), FC_INDEX, 0, &index);
  return FontFile{textOf(file), index & 0xFFFF};
}

}  // namespace sdf
