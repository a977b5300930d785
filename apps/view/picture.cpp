#include "view/picture.hpp"

#include <algorithm>

namespace rill::view {

bool Picture::shows(const Wish& wish, double scale) const {
  return wish.eye.fov_y_deg == eye_.fov_y_deg && std::ranges::equal(wish.eye.eye, eye_.eye) &&
         std::ranges::equal(wish.eye.target, eye_.target) && scale == scale_ && wish.view == view_ && wish.area == area_;
}

Expected<void> Picture::paint(Display& display, Session& session, const Wish& wish) {
  if (const auto took = display.pictureSeconds()) {
    took_s_ = *took;
    if (wish.scale == 0) auto_.drew(*took);
  }
  const double scale = wish.scale > 0 ? wish.scale : auto_.scale();
  if (!wish.changed && shows(wish, scale)) return {};
  if (wish.view == "density" && view_ != "density" && session.runner().between())  // what it shows is measured after each step
    if (auto measured = session.runner().measure(); !measured) return measured.error();
  auto drawn = display.paint(session, wish.view, wish.eye, wish.area, scale, session.runner().time_s());
  if (!drawn && (drawn.error().kind != ErrorKind::BadInput || !any())) return drawn;
  eye_ = wish.eye;
  view_ = wish.view;
  area_ = wish.area;
  scale_ = scale;
  return drawn;
}

}  // namespace rill::view
