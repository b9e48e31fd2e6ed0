/// Normal numbers from uniform ones, by Marsaglia's polar method: only + - * / sqrt.
// SPDX-License-Identifier: MIT
#include "meshreel/distort/noise.h"

#include <cmath>
#include <vector>

#include "meshreel/base/exact.h"
#include "meshreel/base/random.h"
#include "meshreel/distort/moved.h"
#include "meshreel/mesh/weld.h"

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

/// One for each vertex, those that are doubled along seams together: no seam opens.
std::vector<Shift> shifts_of(const Weld& welded, const Request& request, std::uint64_t stream)
{
    GaussianShifts source(request, stream);
    std::vector<Shift> shifts(welded.unique_count());
    for (Shift& shift : shifts) shift = source.next();
    return shifts;
}

} // namespace

Result<Animation> noise_in_vertex_and_frame(const Animation& animation, const Request& request)
{
    const Weld welded = weld(animation, request.threads);
    return moved(animation, request.threads, [&](std::size_t f) {
        return [&, shifts = shifts_of(welded, request, f)](std::size_t v, std::span<const float>) {
            return shifts[welded.unique_of[v]];
        };
    });
}

Result<Animation> noise_in_vertex(const Animation& animation, const Request& request)
{
    const Weld welded = weld(animation, request.threads);
    const std::vector<Shift> shifts = shifts_of(welded, request, 0);
    return moved(animation, request.threads, [&](std::size_t) {
        return [&](std::size_t v, std::span<const float>) { return shifts[welded.unique_of[v]]; };
    });
}

Result<Animation> noise_in_frame(const Animation& animation, const Request& request)
{
    return moved(animation, request.threads, [&](std::size_t f) {
        return [shift = GaussianShifts(request, f).next()](std::size_t, std::span<const float>) { return shift; };
    });
}

} // namespace meshreel::distort
