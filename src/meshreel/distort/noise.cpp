/// Normal numbers from uniform ones, by Marsaglia's polar method: only + - * / sqrt.
// SPDX-License-Identifier: MIT
#include "meshreel/distort/noise.h"

#include <cmath>

#include "meshreel/base/exact.h"
#include "meshreel/base/random.h"
#include "meshreel/distort/moved.h"

namespace meshreel::distort {

namespace {

/// Shifts whose three coordinates are independent and normal.
class GaussianShifts {
public:
    /// stream: another number, another sequence.
    GaussianShifts(const Request& request, std::uint64_t stream)
        : random_(Random(Random(request.seed).bits() + stream).bits()), deviation_(request.amount)
    {
    }

    Shift next() { return {normal(), normal(), normal()}; }

private:
    double normal()
    {
        for (;;) { // until the point is in the unit disc: 79 % are
            const double x = random_.uniform(-1, 1), y = random_.uniform(-1, 1), s = x * x + y * y;
            if (s > 0 && s < 1) return deviation_ * (x * std::sqrt(-2 * exact::log(s) / s));
        }
    }

    Random random_;
    double deviation_;
};

} // namespace

Result<Animation> noise_in_vertex_and_frame(const Animation& animation, const Request& request)
{
    return moved(animation, request.threads, [&](std::size_t f) {
        return [shifts = GaussianShifts(request, f)](std::size_t, std::span<const float>) mutable {
            return shifts.next();
        };
    });
}

Result<Animation> noise_in_vertex(const Animation& animation, const Request& request)
{
    GaussianShifts shifts(request, 0);
    std::vector<Shift> of_vertices(animation.vertex_count);
    for (Shift& shift : of_vertices) shift = shifts.next();
    return moved(animation, request.threads,
                 [&](std::size_t) { return [&](std::size_t v, std::span<const float>) { return of_vertices[v]; }; });
}

Result<Animation> noise_in_frame(const Animation& animation, const Request& request)
{
    return moved(animation, request.threads, [&](std::size_t f) {
        return [shift = GaussianShifts(request, f).next()](std::size_t, std::span<const float>) { return shift; };
    });
}

} // namespace meshreel::distort
