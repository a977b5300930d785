// How whitewater is drawn; shared by C++ and GLSL.
#ifndef RILL_WHITEWATER_VIEW_RECORDS_H
#define RILL_WHITEWATER_VIEW_RECORDS_H
#include "shared/interop.h"
RILL_RECORDS_BEGIN

RILL_CONST uint kWhiteSplatGroup = 64u;
RILL_CONST uint kWhiteLayers = 4u;          // words a pixel: before the surface; behind it as red, green and blue light
RILL_CONST float kWhiteOpacity = 4096.0f;   // counts of an optical depth of 1
RILL_CONST float kWhiteMaxPixels = 24.0f;   // largest radius of a dot

// Areas of dots, over their mean, are distributed exponentially up to the largest; the random bits of a tag that has the mean.
RILL_CONST float kWhiteMaxArea = 6.0f;
RILL_CONST uint kWhiteMeanTag = 0x805e2d00u;

RILL_CONST float kWhiteMaxStreak = 24.0f, kWhiteMaxStreakPixels = 96.0f;  // longest streak: radii of its dot, and pixels

// How long spray is exposed, and the motion of the camera that it is seen from.
struct WhiteExposure {
  float size;                    // m, radius of a particle's parcel
  float seconds;
  float driftX, driftY, driftZ;  // m/s, of what the camera is fixed to at the origin of positions
  float turnX, turnY, turnZ;     // rad/s
};

RILL_RECORDS_END
#endif
