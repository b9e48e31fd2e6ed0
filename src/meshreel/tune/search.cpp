/// A search by secants for the step, inside a descent over the number of bases.
// SPDX-License-Identifier: MIT
#include "meshreel/tune/search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "meshreel/base/text.h"

namespace meshreel::tune {

namespace {

using codecs::Settings;

constexpr double loose = 0.93, tight = 0.99; // how far below the target a step may end

/// Smaller is better; none is worst.
bool better(const std::optional<Attempt>& a, const std::optional<Attempt>& b)
{
    return a && (!b || a->size < b->size);
}

class Search {
public:
    explicit Search(const Problem& problem) : problem_(problem) {}

    /// The coarsest step, everything else given, whose distortion is within [tolerance, 1] of the target; none where
    /// no step gets there. Works on logarithms, where distortion is nearly linear in the step.
    Result<std::optional<Attempt>> solve(Settings settings, double tolerance)
    {
        constexpr int most_attempts = 14;
        constexpr double steepest = std::numeric_limits<double>::infinity();
        double fine = -steepest, coarse = steepest; // brackets of log step
        double x = std::log(settings.step);
        std::optional<Attempt> best;
        for (int i = 0; i < most_attempts; ++i) {
            settings.step = std::exp(x);
            MESHREEL_TRY(const Attempt attempt, problem_.attempt(settings));
            report(problem_.progress, "search", 1.0 - 1.0 / (1.0 + 0.1 * ++count_));
            const double ratio = attempt.distortion / problem_.target;
            if (ratio <= 1.0 && better(attempt, best)) best = attempt;
            if (ratio <= 1.0 && ratio >= tolerance) break;
            (ratio <= 1.0 ? fine : coarse) = x;
            x = next(x, ratio, tolerance, {fine, coarse});
        }
        return best;
    }

private:
    struct Bracket {
        double fine, coarse;
    };

    /// Aims at the middle of the tolerance; halves the bracket where the aim leaves it.
    static double next(double x, double ratio, double tolerance, Bracket bracket)
    {
        const double aim = 0.5 * (1.0 + tolerance);
        const double jump = ratio > 0 ? std::clamp(std::log(aim / ratio), -4.0, 4.0) : 4.0;
        const double wanted = x + jump;
        const double width = bracket.coarse - bracket.fine;
        if (!std::isfinite(width)) return wanted;
        const double margin = 0.05 * width;
        if (wanted > bracket.fine + margin && wanted < bracket.coarse - margin) return wanted;
        return 0.5 * (bracket.fine + bracket.coarse);
    }

    const Problem& problem_;
    int count_ = 0;
};

/// Tries neighbours of the best along one setting for as long as they are smaller.
/// vary(settings, direction) moves one step, false where there is nowhere to go.
template <class Vary>
Status descend(Search& search, Attempt& best, const Vary& vary)
{
    constexpr int most_moves = 3;
    for (int direction : {-1, 1}) {
        bool moved = false;
        for (int move = 0; move < most_moves; ++move) {
            Settings settings = best.settings;
            if (!vary(settings, direction)) break;
            MESHREEL_TRY(const std::optional<Attempt> attempt, search.solve(settings, tight));
            if (!better(attempt, best)) break;
            best = *attempt;
            moved = true;
        }
        if (moved) break;
    }
    return Ok{};
}

bool vary_bases(Settings& settings, int direction)
{
    const auto K = static_cast<std::int64_t>(*settings.bases);
    const std::int64_t next = K + direction * std::max<std::int64_t>(1, K / 16);
    if (next < 1) return false;
    settings.bases = static_cast<std::uint32_t>(next);
    return true;
}

bool vary_ratio(Settings& settings, int direction)
{
    settings.basis_ratio *= direction > 0 ? 1.35 : 1.0 / 1.35;
    return true;
}

} // namespace

Result<std::optional<Attempt>> coarsest(const Problem& problem, const Settings& settings)
{
    return Search(problem).solve(settings, tight);
}

Result<Attempt> smallest(const Problem& problem, Settings start)
{
    Search search(problem);
    std::optional<Attempt> best;
    for (double truncation : problem.truncations) {
        start.truncation = truncation;
        start.bases.reset();
        MESHREEL_TRY(const std::optional<Attempt> attempt, search.solve(start, loose));
        if (best && !better(attempt, best)) break;
        if (attempt) {
            best = attempt;
            start.step = attempt->settings.step;
        }
    }
    if (!best)
        return Error{
            ErrorCode::missed, concat("no setting of the codec reaches the target of ", problem.target), {}, {}, {}};
    if (!problem.refine) return *best;
    MESHREEL_TRY(const std::optional<Attempt> exact, search.solve(best->settings, tight));
    if (better(exact, best)) best = exact;
    MESHREEL_CHECK(descend(search, *best, vary_bases));
    MESHREEL_CHECK(descend(search, *best, vary_ratio));
    return *best;
}

} // namespace meshreel::tune
