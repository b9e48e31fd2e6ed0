/// Sines that are the same on every machine.
// SPDX-License-Identifier: MIT
#include "meshreel/distort/waves.h"

#include <algorithm>
#include <cmath>

#include "meshreel/base/exact.h"
#include "meshreel/distort/moved.h"

namespace meshreel::distort {

namespace {

constexpr double whole_turn = 0x1.921fb54442d18p+2; // 2 pi

/// exact::sin knows angles up to a million.
Status check_angle(double largest)
{
    if (largest < 1e6) return Ok{};
    return Error{ErrorCode::usage, "the wave has more than a million radians: omega is too large", "omega"};
}

} // namespace

Result<Animation> sine_in_space(const Animation& animation, const Request& request)
{
    const double length = body_diagonal(animation), usual = length > 0 ? 10 * whole_turn / length : 1.0;
    const double A = request.amount, omega = request.omega.value_or(usual);
    double farthest = 0.0;
    for (std::size_t i = 0; i < animation.positions.size(); i += 3)
        farthest = std::max(farthest, std::abs(static_cast<double>(animation.positions[i])));
    MESHREEL_CHECK(check_angle(omega * farthest));
    return moved(animation, request.threads, [&](std::size_t) {
        return [&](std::size_t, std::span<const float> p) {
            const double wave = A * exact::sin(omega * p[0]);
            return Shift{wave, wave, wave};
        };
    });
}

Result<Animation> sine_in_time(const Animation& animation, const Request& request)
{
    const double A = request.amount, omega = request.omega.value_or(whole_turn / 10);
    MESHREEL_CHECK(check_angle(omega * static_cast<double>(animation.frame_count())));
    return moved(animation, request.threads, [&](std::size_t f) {
        const double wave = A * exact::sin(omega * static_cast<double>(f));
        return [wave](std::size_t, std::span<const float>) { return Shift{wave, wave, wave}; };
    });
}

} // namespace meshreel::distort
