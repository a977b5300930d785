#include "view/picture.hpp"

#include <algorithm>

namespace rill::view {

bool Picture::shows(const Request& request, double scale) const {
  return request.eye.fov_y_deg == eye_.fov_y_deg && std::ranges::equal(request.eye.eye, eye_.eye) &&
         std::ranges::equal(request.eye.target, eye_.target) && scale == scale_ && request.exposure_stops == exposure_stops_ &&
         request.view == view_ && request.area == area_;
}

Expected<void> Picture::paint(Display& display, Session& session, const Request& request) {
  if (const auto took = display.pictureSeconds()) {
    took_s_ = *took;
    if (request.scale == 0) auto_.addImage(*took);
  }
  const double scale = request.scale > 0 ? request.scale : auto_.scale();
  if (!request.changed && shows(request, scale)) return {};
  if (request.view == "density" && view_ != "density" &&
      session.runner().betweenSteps())  // the view shows a density that is only measured for it
    if (auto measured = session.runner().measure(); !measured) return measured.error();
  session.painter().expose(request.exposure_stops);
  auto drawn = display.paint(session, request.view, request.eye, request.area, scale, session.runner().time_s());
  if (!drawn && (drawn.error().kind != ErrorKind::BadInput || !any())) return drawn;
  eye_ = request.eye;
  view_ = request.view;
  exposure_stops_ = request.exposure_stops;
  area_ = request.area;
  scale_ = scale;
  return drawn;
}

}  // namespace rill::view
