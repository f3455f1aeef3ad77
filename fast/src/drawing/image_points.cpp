#include "drawing/image_points.hpp"

#include "drawing/short_product.hpp"
#include "exact/nearest_double.hpp"

namespace halfspace::fast {
/// Between values f and g of different signs at the ends, a form is 0 at
/// from |g| + to |f|, for homogeneous points.
ExactImagePoint ImagePoints::exact(const Line& line, const Cut& cut) const {
  const auto at_end = [&](const SpacePoint& p) {
    return ExactImagePoint{CutProduct(value_at(sight_.x_form(), p)),
                           CutProduct(value_at(sight_.y_form(), p)),
                           CutProduct(value_at(sight_.w_form(), p))};
  };
  if (cut.kind == CutKind::kFrom) return at_end(line.from);
  if (cut.kind == CutKind::kTo) return at_end(line.to);
  const Form form = hiding_.form_of(cut);
  const FormValue f = size_of(value_at(form, line.from));
  const FormValue g = size_of(value_at(form, line.to));
  const auto mean = [&](const Form& of) {
    return short_product<22>(value_at(of, line.from), g) +
           short_product<22>(value_at(of, line.to), f);
  };
  return {mean(sight_.x_form()), mean(sight_.y_form()), mean(sight_.w_form())};
}

DrawingPoint ImagePoints::point(const Line& line, const Cut& cut) const {
  const ExactImagePoint p = exact(line, cut);
  bool rounded = false;
  return {quotient(p.x, p.w, rounded), quotient(p.y, p.w, rounded)};
}

double ImagePoints::share(const Line& line, const Cut& cut) const {
  if (cut.kind == CutKind::kFrom) return 0;
  if (cut.kind == CutKind::kTo) return 1;
  const Form form = hiding_.form_of(cut);
  const CutProduct f =
      short_product<22>(size_of(value_at(form, line.from)), line.to.w);
  const CutProduct g =
      short_product<22>(size_of(value_at(form, line.to)), line.from.w);
  bool rounded = false;
  return quotient(f, f + g, rounded);
}

}  // namespace halfspace::fast
