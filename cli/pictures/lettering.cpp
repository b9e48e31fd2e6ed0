/// The alphabet as a table, curves as quadratic splines, ink by the distance from a stroke.
// SPDX-License-Identifier: MIT
#include "cli/pictures/lettering.h"

#include <algorithm>
#include <cmath>

namespace meshreel::cli {

namespace {

constexpr double grid = 1.0 / 7.0; ///< a capital is seven squares high
constexpr double letter_gap = 1.7; ///< squares between letters

/// Strokes parted by spaces, points as two digits x y on the grid; letters stand on y = 2 and capitals reach 9.
/// `~` begins a curve, the quadratic B-spline of its points; `@` a closed one.
struct Glyph {
    char32_t letter;
    int width;
    const char* strokes;
};

constexpr std::array glyphs{
    Glyph{' ', 2, ""},
    Glyph{'A', 6, "023962 1454"},
    Glyph{'B', 5, "0209 ~093959563606 ~063656523202"},
    Glyph{'C', 6, "~676909026264"},
    Glyph{'D', 6, "0209 ~093969623202"},
    Glyph{'E', 4, "49090242 0636"},
    Glyph{'F', 4, "490902 0636"},
    Glyph{'G', 6, "~676909026265 6545"},
    Glyph{'H', 5, "0209 5259 0656"},
    Glyph{'I', 0, "0209"},
    Glyph{'J', 4, "4944 ~44420204"},
    Glyph{'K', 5, "0209 5905 1652"},
    Glyph{'L', 4, "090242"},
    Glyph{'M', 6, "0209346962"},
    Glyph{'N', 5, "02095259"},
    Glyph{'O', 6, "@09696202"},
    Glyph{'P', 5, "0209 ~093959553505"},
    Glyph{'Q', 6, "@09696202 4461"},
    Glyph{'R', 5, "0209 ~093959553505 2552"},
    Glyph{'S', 5, "~5759090655520204"},
    Glyph{'T', 6, "0969 3932"},
    Glyph{'U', 5, "0904 ~04025254 5459"},
    Glyph{'V', 6, "093269"},
    Glyph{'W', 8, "0922486289"},
    Glyph{'X', 5, "0259 0952"},
    Glyph{'Y', 6, "093569 3532"},
    Glyph{'Z', 5, "09590252"},
    Glyph{'a', 4, "@07474202 4742"},
    Glyph{'b', 4, "0209 @07474202"},
    Glyph{'c', 4, "~464707024243"},
    Glyph{'d', 4, "@07474202 4249"},
    Glyph{'e', 4, "0545 ~454707024243"},
    Glyph{'f', 3, "~391917 1712 0737"},
    Glyph{'g', 4, "@07474202 4742 ~42400001"},
    Glyph{'h', 4, "0209 ~05074745 4542"},
    Glyph{'i', 0, "0702 09"},
    Glyph{'j', 1, "1712 ~121000 19"},
    Glyph{'k', 4, "0209 4704 1542"},
    Glyph{'l', 0, "0902"},
    Glyph{'m', 6, "0702 ~05073735 3532 ~35376765 6562"},
    Glyph{'n', 4, "0702 ~05074745 4542"},
    Glyph{'o', 4, "@07474202"},
    Glyph{'p', 4, "0700 @07474202"},
    Glyph{'q', 4, "@07474202 4740"},
    Glyph{'r', 3, "0702 ~050737"},
    Glyph{'s', 4, "~4647070544420203"},
    Glyph{'t', 3, "1914 ~141232 0737"},
    Glyph{'u', 4, "0704 ~04024244 4742"},
    Glyph{'v', 4, "072247"},
    Glyph{'w', 6, "0722364267"},
    Glyph{'x', 4, "0742 0247"},
    Glyph{'y', 4, "0722 4710"},
    Glyph{'z', 4, "07470242"},
    Glyph{'0', 4, "@09494202"},
    Glyph{'1', 4, "072922"},
    Glyph{'2', 4, "~0709494602 0242"},
    Glyph{'3', 4, "~0709494626 ~2646420203"},
    Glyph{'4', 4, "390444 3932"},
    Glyph{'5', 4, "490906 ~0647420203"},
    Glyph{'6', 4, "~48490904 @06464202"},
    Glyph{'7', 4, "094912"},
    Glyph{'8', 4, "@09494606 @06464202"},
    Glyph{'9', 4, "@09494505 ~47420203"},
    Glyph{'.', 0, "02"},
    Glyph{',', 1, "1201"},
    Glyph{':', 0, "03 07"},
    Glyph{';', 1, "1301 17"},
    Glyph{'!', 0, "0904 02"},
    Glyph{'?', 4, "~0709494524 22"},
    Glyph{'-', 3, "0535"},
    Glyph{'+', 4, "0545 2723"},
    Glyph{'*', 4, "0446 0644 2723"},
    Glyph{'/', 3, "0139"},
    Glyph{'\\', 3, "0931"},
    Glyph{'|', 0, "0900"},
    Glyph{'=', 4, "0646 0444"},
    Glyph{'<', 4, "470543"},
    Glyph{'>', 4, "074503"},
    Glyph{'%', 6, "@09292707 @44646242 6902"},
    Glyph{'#', 5, "1209 4239 0757 0454"},
    Glyph{'&', 5, "~523806092934 ~34020224 ~24425355"},
    Glyph{'(', 2, "~290521"},
    Glyph{')', 2, "~092501"},
    Glyph{'[', 2, "29090121"},
    Glyph{']', 2, "09292101"},
    Glyph{'_', 4, "0141"},
    Glyph{'\'', 0, "0907"},
    Glyph{'"', 2, "0907 2927"},
    Glyph{'^', 4, "072947"},
    Glyph{U'²', 2, "~0809292805 0525"},
    Glyph{U'³', 2, "~0809292717 ~1727250506"},
    Glyph{U'°', 2, "@09292707"},
    Glyph{U'·', 0, "05"},
    Glyph{U'×', 4, "0743 0347"},
    Glyph{U'µ', 4, "0700 ~04024244 4742"},
    Glyph{U'–', 4, "0545"},
    Glyph{U'∞', 6, "~35373333 @05272403 @36676343"},
};

const Glyph& glyph_of(char32_t letter)
{
    const auto found = std::find_if(glyphs.begin(), glyphs.end(), [&](const Glyph& g) { return g.letter == letter; });
    return found != glyphs.end() ? *found : letter == '?' ? glyphs.front() : glyph_of('?');
}

/// The letters of UTF-8; a byte that is none becomes a question mark.
std::u32string letters_of(std::string_view text)
{
    std::u32string letters;
    for (std::size_t i = 0; i < text.size();) {
        const auto first = static_cast<unsigned char>(text[i]);
        const std::size_t length = first < 0x80 ? 1 : first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : first >= 0xc0 ? 2 : 0;
        if (length == 0 || i + length > text.size()) {
            letters += U'?';
            ++i;
            continue;
        }
        char32_t letter = length == 1 ? first : first & (0x7fu >> length);
        for (std::size_t j = 1; j < length; ++j) letter = letter << 6 | (static_cast<unsigned char>(text[i + j]) & 63u);
        letters += letter;
        i += length;
    }
    return letters;
}

using GridPoint = std::array<double, 2>;

GridPoint middle(const GridPoint& a, const GridPoint& b)
{
    return {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])};
}

/// Appends the parabola that leaves `from` towards `by` and arrives at `to`, without its first point.
void append_parabola(Stroke& stroke, const GridPoint& by, const GridPoint& to)
{
    constexpr int pieces = 6;
    const GridPoint from = stroke.back();
    for (int i = 1; i <= pieces; ++i) {
        const double t = static_cast<double>(i) / pieces, u = 1.0 - t;
        GridPoint p{};
        for (std::size_t c = 0; c < 2; ++c) p[c] = u * u * from[c] + 2.0 * u * t * by[c] + t * t * to[c];
        stroke.push_back(p);
    }
}

/// The quadratic B-spline of control points: through the first and the last where it is open.
Stroke spline(const Stroke& control, bool closed)
{
    const std::size_t n = control.size();
    Stroke stroke{closed ? middle(control[n - 1], control[0]) : control[0]};
    for (std::size_t i = closed ? 0 : 1; i + (closed ? 0 : 1) < n; ++i) {
        const bool last = !closed && i + 2 == n;
        append_parabola(stroke, control[i], last ? control[i + 1] : middle(control[i], control[(i + 1) % n]));
    }
    return stroke;
}

Stroke parse_stroke(std::string_view text)
{
    const char kind = text[0];
    if (kind == '~' || kind == '@') text.remove_prefix(1);
    Stroke points;
    for (std::size_t i = 0; i + 1 < text.size(); i += 2)
        points.push_back({static_cast<double>(text[i] - '0'), static_cast<double>(text[i + 1] - '2')});
    return kind == '~' || kind == '@' ? spline(points, kind == '@') : points;
}

void append_glyph(std::vector<Stroke>& all, const Glyph& glyph, double x)
{
    std::string_view rest = glyph.strokes;
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find(' '), rest.size());
        Stroke stroke = parse_stroke(rest.substr(0, end));
        for (GridPoint& p : stroke) p = {(p[0] + x) * grid, p[1] * grid};
        all.push_back(std::move(stroke));
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
}

double distance_from_segment(const GridPoint& p, const GridPoint& a, const GridPoint& b)
{
    const GridPoint along{b[0] - a[0], b[1] - a[1]}, to{p[0] - a[0], p[1] - a[1]};
    const double square = along[0] * along[0] + along[1] * along[1];
    const double t = square > 0.0 ? std::clamp((to[0] * along[0] + to[1] * along[1]) / square, 0.0, 1.0) : 0.0;
    return std::hypot(to[0] - t * along[0], to[1] - t * along[1]);
}

/// Ink on a picture while a text is written: [0, 1] a pixel, so that strokes that cross are no darker.
class Ink {
public:
    explicit Ink(const Image& image) : width_(image.width), height_(image.height), ink_(width_ * height_) {}

    void draw(const GridPoint& a, const GridPoint& b, double radius)
    {
        const std::size_t x1 = pixel(std::max(a[0], b[0]) + radius + 1.0, width_);
        const std::size_t y1 = pixel(std::max(a[1], b[1]) + radius + 1.0, height_);
        for (std::size_t y = pixel(std::min(a[1], b[1]) - radius - 1.0, height_); y < y1; ++y) {
            for (std::size_t x = pixel(std::min(a[0], b[0]) - radius - 1.0, width_); x < x1; ++x) {
                const GridPoint p{static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5};
                const double share = std::clamp(radius + 0.5 - distance_from_segment(p, a, b), 0.0, 1.0);
                float& there = ink_[y * width_ + x];
                there = std::max(there, static_cast<float>(share));
            }
        }
    }

    void lay_on(Image& image, const Colour& colour) const
    {
        for (std::size_t i = 0; i < ink_.size(); ++i)
            if (ink_[i] > 0.0f) blend(image, i, colour, ink_[i]);
    }

private:
    static std::size_t pixel(double at, std::size_t size)
    {
        return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(size)));
    }

    std::size_t width_, height_;
    std::vector<float> ink_;
};

} // namespace

std::vector<Stroke> strokes_of(std::string_view text)
{
    std::vector<Stroke> all;
    double x = 0.0;
    for (char32_t letter : letters_of(text)) {
        append_glyph(all, glyph_of(letter), x);
        x += glyph_of(letter).width + letter_gap;
    }
    return all;
}

double text_width(std::string_view text)
{
    double x = 0.0;
    for (char32_t letter : letters_of(text)) x += glyph_of(letter).width + letter_gap;
    return x > 0.0 ? (x - letter_gap) * grid : 0.0;
}

void write(Image& image, std::array<double, 2> at, std::string_view text, const Pen& pen)
{
    const double shift = pen.align == Align::left ? 0.0 : pen.align == Align::middle ? 0.5 : 1.0;
    const double left = at[0] - shift * pen.size * text_width(text);
    Ink ink(image);
    for (const Stroke& stroke : strokes_of(text)) {
        for (std::size_t i = 0; i < stroke.size(); ++i) {
            const GridPoint& a = stroke[i];
            const GridPoint& b = stroke[std::min(i + 1, stroke.size() - 1)];
            ink.draw({left + pen.size * a[0], at[1] - pen.size * a[1]},
                     {left + pen.size * b[0], at[1] - pen.size * b[1]}, 0.5 * pen.weight * pen.size);
        }
    }
    ink.lay_on(image, pen.colour);
}

} // namespace meshreel::cli
