/// Secants along the step, and a descent over the other settings.
// SPDX-License-Identifier: MIT
#include "meshreel/tune/search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace meshreel::tune {

namespace {

using codecs::Settings;

constexpr double aimed_excess = 0.992; // what the next attempt aims at
constexpr double least_excess = 0.97;  // worth verifying, and then good enough
constexpr double most_mended = 1.5;    // beyond it too many vertices miss the limit
constexpr double worth_it = 0.001;     // log of the price, of a move along a knob
constexpr double no_bracket = std::numeric_limits<double>::infinity();

/// The excess along the step, everything else being equal: y = log excess over x = log step, turned so that it rises.
class Line {
public:
    explicit Line(bool rises) : sign_(rises ? 1.0 : -1.0), usual_slope_(rises ? 0.9 : 0.5) {}

    void add(const Attempt& attempt)
    {
        points_.push_back({sign_ * std::log(attempt.settings.step), logarithm(attempt.excess)});
    }
    /// Forgets all but how steep it was.
    void restart()
    {
        usual_slope_ = slope();
        points_.clear();
    }
    /// All excesses turned out to be so many times larger.
    void correct(double factor)
    {
        for (Point& point : points_) point.y += std::log(factor);
    }
    /// Whether more attempts could tell nothing: the last two are far apart, or one and the same, and agree.
    bool flat() const
    {
        if (points_.size() < 2) return false;
        const Point &a = points_.back(), &b = points_[points_.size() - 2];
        return std::abs(a.y - b.y) < 1e-6 && (a.x == b.x || std::abs(a.x - b.x) > 0.5);
    }
    bool narrow() const
    {
        const auto [fine, coarse] = bracket();
        return coarse - fine < 1e-5;
    }
    /// The step to try next. @pre a point was added
    double next() const
    {
        const double goal = std::log(aimed_excess);
        Point near = nearest()[0];
        const auto [fine, coarse] = bracket();
        for (const Point& point : points_) // beyond all that keep the limit, though a finer one came nearer to it
            if (!std::isfinite(coarse) && point.x > near.x) near = point;
        const double jump = std::clamp((goal - near.y) / slope(), -4.0, 4.0);
        if (!std::isfinite(coarse - fine)) return std::exp(sign_ * within_reach(near.x + boldness() * jump));
        const double x = near.x + jump, margin = 0.05 * (coarse - fine);
        if (!(x > fine + margin && x < coarse - margin)) return std::exp(sign_ * 0.5 * (fine + coarse));
        return std::exp(sign_ * x);
    }

private:
    struct Point {
        double x, y;
    };
    struct Bracket {
        double fine, coarse;
    };

    /// The points, nearest to the goal first.
    std::vector<Point> nearest() const
    {
        const double goal = std::log(aimed_excess);
        std::vector<Point> near = points_;
        std::sort(near.begin(), near.end(),
                  [&](Point a, Point b) { return std::abs(a.y - goal) < std::abs(b.y - goal); });
        return near;
    }

    double slope() const
    {
        const std::vector<Point> near = nearest();
        if (near.size() < 2 || std::abs(near[1].x - near[0].x) < 1e-6) return usual_slope_;
        const double secant = (near[1].y - near[0].y) / (near[1].x - near[0].x), usual = sign_ > 0 ? 0.9 : 0.5;
        return std::clamp(secant, 0.4 * usual, 2 * usual);
    }

    /// Larger and larger jumps where none has crossed the limit yet: an excess may stay the same for a while.
    double boldness() const { return std::exp2(std::max(0.0, static_cast<double>(points_.size()) - 3.0)); }

    /// Steps stay numbers.
    double within_reach(double x) const
    {
        constexpr double reach = 60.0;
        return std::clamp(x, points_.front().x - reach, points_.front().x + reach);
    }

    static double logarithm(double excess) { return excess > 0 ? std::max(std::log(excess), -40.0) : -40.0; }

    /// The coarsest step known to keep the limit, and the finest beyond it known not to.
    Bracket bracket() const
    {
        Bracket bracket{-no_bracket, no_bracket};
        for (const Point& point : points_)
            if (point.y <= 0) bracket.fine = std::max(bracket.fine, point.x);
        for (const Point& point : points_)
            if (point.y > 0 && point.x > bracket.fine) bracket.coarse = std::min(bracket.coarse, point.x);
        return bracket;
    }

    double sign_, usual_slope_;
    std::vector<Point> points_;
};

class Search {
public:
    explicit Search(const Problem& problem) : problem_(problem), exchange_(problem.rises ? 0.6 : 1.7) {}

    Result<Attempt> run(const Settings& start)
    {
        Settings settings = start;
        Line line(problem_.rises);
        if (!problem_.knobs.empty()) {
            MESHREEL_TRY(Attempt near, approach(settings, line));
            MESHREEL_CHECK(try_lengths(near));
            MESHREEL_CHECK(vary(near));
            line.restart();
            return land(std::move(near), line);
        }
        MESHREEL_TRY(Attempt first, attempted(settings));
        return land(std::move(first), line);
    }

private:
    Result<Attempt> attempted(const Settings& settings)
    {
        report(problem_.progress, "search", 1.0 - 1.0 / (1.0 + 0.1 * ++count_));
        return problem_.attempt(settings);
    }

    /// An attempt near the limit on either side, and what excess costs there: from two attempts that differ enough.
    Result<Attempt> approach(Settings settings, Line& line)
    {
        constexpr int most_attempts = 4;
        constexpr double near_enough = 0.1, telling = 0.05, other_step = 0.87;
        MESHREEL_TRY(Attempt attempt, attempted(settings));
        for (int i = 1; i < most_attempts && !line.flat(); ++i) {
            line.add(attempt);
            const double step = settings.step;
            settings.step = line.next();
            const bool same = std::abs(std::log(settings.step / step)) < telling;
            if (same) settings.step = step * other_step;
            MESHREEL_TRY(Attempt next, attempted(settings));
            learn_exchange(attempt, next);
            if (!same) attempt = std::move(next);
            if (same || std::abs(std::log(attempt.excess)) < near_enough) break;
        }
        return attempt;
    }

    void learn_exchange(const Attempt& a, const Attempt& b)
    {
        const double excess = std::log(b.excess / a.excess), cost = std::log(b.cost / a.cost);
        const double usual = problem_.rises ? 0.6 : 1.7, exchange = -cost / excess;
        if (std::isfinite(exchange)) exchange_ = std::clamp(exchange, 0.4 * usual, 2.5 * usual);
    }

    /// log of what an attempt would cost if it kept the limit exactly.
    double price(const Attempt& attempt) const { return std::log(attempt.cost) + exchange_ * std::log(attempt.excess); }

    /// Relaxing, and where that pays, guesses that keep lengths too.
    Status try_lengths(Attempt& best)
    {
        if (!(problem_.spread <= problem_.telling * best.mean_square)) return Ok{};
        for (bool Settings::*way : {&Settings::relax, &Settings::lengths}) {
            MESHREEL_TRY(const bool pays, try_way(best, way));
            if (!pays) break;
        }
        return Ok{};
    }

    /// Decoders have work with it: only where it saves what is worth that.
    Result<bool> try_way(Attempt& best, bool Settings::*way)
    {
        constexpr double worth_work = 0.02;
        Settings settings = best.settings;
        settings.*way = true;
        MESHREEL_TRY(Attempt attempt, attempted(settings));
        const bool pays = price(attempt) < price(best) - worth_work;
        if (pays) best = std::move(attempt);
        return pays;
    }

    /// All knobs, round after round; nearer by where a round moved none. Between rounds weights are found anew oftener.
    Status vary(Attempt& best)
    {
        double nearness = 1.0;
        for (int round = 0; round < problem_.rounds; ++round) {
            bool moved = false;
            if (round > 0) MESHREEL_CHECK(renew_oftener(best));
            for (Knob knob : problem_.knobs) {
                knob.factor = std::pow(knob.factor, 1.0 / nearness);
                MESHREEL_TRY(const bool by_this, descend(best, knob));
                moved = moved || by_this;
            }
            if (!moved) nearness *= 2;
        }
        return Ok{};
    }

    /// By an eighth, where that pays. From the start it would not always: it is tried where all else has its place.
    Status renew_oftener(Attempt& best)
    {
        if (best.settings.growth <= 1) return Ok{};
        Settings settings = best.settings;
        --settings.growth;
        MESHREEL_TRY(Attempt attempt, attempted(settings));
        if (price(attempt) < price(best) - worth_it) best = std::move(attempt);
        return Ok{};
    }

    /// Moves along a knob for as long as it pays; whether it did.
    Result<bool> descend(Attempt& best, const Knob& knob)
    {
        constexpr int most_moves = 3;
        for (double factor : {1.0 / knob.factor, knob.factor}) {
            bool moved = false;
            for (int move = 0; move < most_moves; ++move) {
                Settings settings = best.settings;
                double& value = settings.*knob.setting;
                const double wanted = std::clamp(value * factor, knob.least, knob.most);
                if (wanted == value) break;
                value = wanted;
                MESHREEL_TRY(Attempt attempt, attempted(settings));
                if (!(price(attempt) < price(best) - worth_it)) break;
                best = std::move(attempt);
                moved = true;
            }
            if (moved) return true;
        }
        return false;
    }

    /// From an attempt somewhere to a verified one just below the limit.
    Result<Attempt> land(Attempt attempt, Line line)
    {
        constexpr int enough_attempts = 12, most_attempts = 20; // enough where one keeps the limit
        const double usual_truncation = attempt.settings.truncation;
        Landing landing;
        for (int i = 1;; ++i) {
            attempt.excess *= landing.correction;
            if (problem_.mend && attempt.excess > 1.0 && attempt.excess < most_mended) {
                MESHREEL_TRY(attempt, problem_.mend(std::move(attempt)));
                attempt.excess *= landing.correction;
            }
            if (problem_.rises && landing.holds_first(attempt)) line.restart(); // fewer components have another line
            line.add(attempt);
            Settings settings = attempt.settings;
            landing.consider(std::move(attempt));
            const bool settled = i >= enough_attempts || line.flat() || line.narrow();
            if (landing.promising() || settled) MESHREEL_CHECK(verify(landing, line));
            if (landing.reached >= least_excess || (settled && landing.best) || i == most_attempts) break;
            settings.step = line.next();
            settings.truncation = landing.enough ? *landing.enough / settings.step : usual_truncation;
            MESHREEL_TRY(attempt, attempted(settings));
        }
        if (landing.best) return *std::move(landing.best);
        return Error{ErrorCode::missed, "no setting of the codec keeps it", {}, {}, {}};
    }

    /// What the last part of the search knows.
    struct Landing {
        std::optional<Attempt> candidate, best; ///< nearest below the limit: not verified yet, and verified
        double correction = 1.0;                ///< of excesses, as verification taught
        double reached = 0.0;                   ///< the verified excess of the best
        std::optional<double> enough;           ///< truncation x step of the first that kept the limit: errors jump
                                                ///< where a component is left out

        /// Whether an attempt is the first to keep the limit, and not by far: later ones get as many components.
        bool holds_first(const Attempt& attempt)
        {
            if (enough || attempt.excess > 1.0 || attempt.excess < 0.6) return false;
            enough = attempt.settings.truncation * attempt.settings.step;
            return true;
        }
        void consider(Attempt attempt)
        {
            if (attempt.excess <= 1.0 && attempt.excess > (candidate ? candidate->excess : reached))
                candidate = std::move(attempt);
        }
        bool promising() const { return candidate && candidate->excess >= least_excess; }
    };

    Status verify(Landing& landing, Line& line) const
    {
        if (!landing.candidate) return Ok{};
        Attempt attempt = *std::move(landing.candidate);
        landing.candidate.reset();
        MESHREEL_TRY(const double excess, problem_.verify(attempt));
        if (attempt.excess > 0 && excess > 0) {
            landing.correction *= excess / attempt.excess;
            line.correct(excess / attempt.excess);
        }
        if (!(excess <= 1.0) || (landing.best && excess <= landing.reached)) return Ok{};
        landing.reached = excess;
        landing.best = std::move(attempt);
        return Ok{};
    }

    const Problem& problem_;
    double exchange_; ///< a percent of excess costs so many percent
    int count_ = 0;
};

} // namespace

Result<Attempt> cheapest(const Problem& problem, const Settings& start)
{
    return Search(problem).run(start);
}

} // namespace meshreel::tune
