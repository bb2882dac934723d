#include "base/tabular_font.h"

#include <QFontDatabase>
#include <QFontMetricsF>
#include <QRawFont>
#include <QtEndian>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace emca::explorer {
namespace {

/// Big-endian numbers of a font table; reading beyond its end gives 0.
struct Table {
    QByteArray bytes;
    std::uint16_t u16(std::size_t at) const {
        return at + 2 <= static_cast<std::size_t>(bytes.size()) ? qFromBigEndian<quint16>(bytes.constData() + at) : quint16(0);
    }
    std::uint32_t u32(std::size_t at) const { return std::uint32_t(u16(at)) << 16 | u16(at + 2); }
};

void put16(QByteArray& out, std::uint32_t value) {
    out.append(static_cast<char>(value >> 8)).append(static_cast<char>(value));
}
void put32(QByteArray& out, std::uint32_t value) {
    put16(out, value >> 16);
    put16(out, value & 0xffff);
}

/// Position of a glyph in a coverage table, if it is there.
std::optional<std::uint32_t> coverage(const Table& t, std::size_t at, std::uint32_t glyph) {
    const std::uint32_t format = t.u16(at), count = t.u16(at + 2);
    for (std::uint32_t i = 0; i < count; ++i) {
        if (format == 1 && t.u16(at + 4 + 2 * i) == glyph) return i;
        const std::size_t range = at + 4 + 6 * std::size_t(i);
        if (format == 2 && glyph >= t.u16(range) && glyph <= t.u16(range + 2)) return t.u16(range + 4) + glyph - t.u16(range);
    }
    return std::nullopt;
}

/// Single substitution (lookup type 1) of one glyph, also behind an extension (type 7).
std::optional<std::uint32_t> substitute(const Table& t, std::size_t lookup, std::uint32_t glyph) {
    for (std::uint32_t i = 0; i < t.u16(lookup + 4); ++i) {
        std::size_t at = lookup + t.u16(lookup + 6 + 2 * i);
        std::uint32_t type = t.u16(lookup);
        if (type == 7) {
            type = t.u16(at + 2);
            at += t.u32(at + 4);
        }
        if (type != 1) continue;
        const auto index = coverage(t, at + t.u16(at + 2), glyph);
        if (!index) continue;
        return t.u16(at) == 1 ? (glyph + t.u16(at + 4)) & 0xffff : t.u16(at + 6 + 2 * std::size_t(*index));
    }
    return std::nullopt;
}

/// What the feature "tnum" makes of a glyph.
std::optional<std::uint32_t> tabularGlyph(const Table& gsub, std::uint32_t glyph) {
    const std::size_t features = gsub.u16(6), lookups = gsub.u16(8);
    for (std::uint32_t i = 0; i < gsub.u16(features); ++i) {
        const std::size_t record = features + 2 + 6 * std::size_t(i);
        if (gsub.u32(record) != 0x746e756du) continue;  // "tnum"
        const std::size_t feature = features + gsub.u16(record + 4);
        for (std::uint32_t k = 0; k < gsub.u16(feature + 2); ++k)
            if (const auto found = substitute(gsub, lookups + gsub.u16(lookups + 2 + 2 * gsub.u16(feature + 4 + 2 * k)), glyph))
                return found;
    }
    return std::nullopt;
}

/// A character map (format 12) of the font's own characters with tabular digits. Empty without such digits.
QByteArray characterMap(const QRawFont& font) {
    const Table gsub{font.fontTable("GSUB")};
    QByteArray groups;
    std::uint32_t count = 0;
    bool digits = false;
    for (char16_t code = 0x20; code < 0x3000; ++code) {
        quint32 glyph = 0;
        int found = 1;
        const QChar character(code);
        if (!font.glyphIndexesForChars(&character, 1, &glyph, &found) || found < 1 || glyph == 0) continue;
        if (const auto tabular = code < 0x7f ? tabularGlyph(gsub, glyph) : std::nullopt) {
            glyph = *tabular;
            digits = digits || (code >= '0' && code <= '9');
        }
        put32(groups, code);
        put32(groups, code);
        put32(groups, glyph);
        ++count;
    }
    if (!digits) return {};
    QByteArray out;
    put16(out, 0);
    put16(out, 2);
    // Unicode in full, for Unicode and for Windows. Without the first FreeType makes a map of its own from the glyphs'
    // names and prefers it.
    for (const auto& [platform, encoding] : {std::pair(0u, 4u), std::pair(3u, 10u)}) {
        put16(out, platform);
        put16(out, encoding);
        put32(out, 20);
    }
    put16(out, 12);
    put16(out, 0);
    put32(out, static_cast<std::uint32_t>(16 + groups.size()));
    put32(out, 0);
    put32(out, count);
    return out + groups;
}

QByteArray nameTable(const QString& family, const QString& style) {
    const std::vector<std::pair<std::uint32_t, QString>> names{
        {1, family}, {2, style}, {4, family + ' ' + style}, {6, QString(family + '-' + style).remove(' ')}};
    QByteArray records, strings;
    for (const auto& [id, text] : names) {
        QByteArray utf16;
        for (const QChar c : text) put16(utf16, c.unicode());
        for (const std::uint32_t v : {3u, 1u, 0x409u, id, static_cast<std::uint32_t>(utf16.size()),
                                      static_cast<std::uint32_t>(strings.size())})
            put16(records, v);
        strings += utf16;
    }
    QByteArray out;
    put16(out, 0);
    put16(out, static_cast<std::uint32_t>(names.size()));
    put16(out, static_cast<std::uint32_t>(6 + records.size()));
    return out + records + strings;
}

/// Tables in one file. Checksums stay 0: font libraries do not read them.
QByteArray fontFile(const std::map<QByteArray, QByteArray>& tables) {
    QByteArray header, body;
    put32(header, tables.count("CFF ") ? 0x4f54544fu : 0x00010000u);
    put16(header, static_cast<std::uint32_t>(tables.size()));
    put16(header, 0);
    put16(header, 0);
    put16(header, 0);
    const auto start = static_cast<std::uint32_t>(12 + 16 * tables.size());
    for (const auto& [tag, bytes] : tables) {
        header += tag;
        put32(header, 0);
        put32(header, start + static_cast<std::uint32_t>(body.size()));
        put32(header, static_cast<std::uint32_t>(bytes.size()));
        body += bytes;
        while (body.size() % 4) body.append('\0');
    }
    return header + body;
}

}  // namespace

bool hasTabularDigits(const QFont& font) {
    const QFontMetricsF metrics(font);
    for (char digit = '1'; digit <= '9'; ++digit)
        if (std::abs(metrics.horizontalAdvance(QLatin1Char(digit)) - metrics.horizontalAdvance(QLatin1Char('0'))) > 1e-3)
            return false;
    return true;
}

QString tabularFamily(const QFont& font) {
    if (hasTabularDigits(font)) return font.family();
    const QRawFont raw = QRawFont::fromFont(font);
    if (!raw.isValid()) return {};
    std::map<QByteArray, QByteArray> tables;
    for (const char* tag : {"CFF ", "glyf", "loca", "cvt ", "fpgm", "prep", "gasp", "head", "hhea", "hmtx", "maxp", "OS/2", "post"})
        if (const QByteArray bytes = raw.fontTable(tag); !bytes.isEmpty()) tables[tag] = bytes;
    tables["cmap"] = characterMap(raw);
    if (tables["cmap"].isEmpty()) return {};
    const QString family = font.family() + " Tabular";
    tables["name"] = nameTable(family, font.weight() > QFont::Normal ? "SemiBold" : "Regular");
    if (QFontDatabase::addApplicationFontFromData(fontFile(tables)) < 0) return {};
    QFont variant(font);
    variant.setFamily(family);
    return hasTabularDigits(variant) ? family : QString();
}

}  // namespace emca::explorer
