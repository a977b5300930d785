#pragma once
// Arithmetic of Double3.
#include <cmath>

#include "rill/vectors.hpp"

namespace rill {

inline Double3 minus(const Double3& a, const Double3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Double3 along(const Double3& from, double t, const Double3& by) { return {from.x + t * by.x, from.y + t * by.y, from.z + t * by.z}; }
inline double dot(const Double3& a, const Double3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline double length(const Double3& v) { return std::sqrt(dot(v, v)); }
/// Of a vector of a length above 0.
inline Double3 normalized(const Double3& v) { return along({}, 1 / length(v), v); }
inline Double3 cross(const Double3& a, const Double3& b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
/// A unit vector across a unit vector; horizontal, unless that one nearly stands upright.
inline Double3 unitAcross(const Double3& v) { return normalized(cross(std::abs(v.y) < 0.9 ? Double3{0, 1, 0} : Double3{0, 0, 1}, v)); }

}  // namespace rill
