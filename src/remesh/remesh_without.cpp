#ifndef PLIANT_HAVE_CGAL
#include "core/error.hpp"
#include "remesh/remesh.hpp"

namespace pliant {

RemeshResult remesh(SurfaceData, const RemeshOptions&) {
  throw InputError("this pliant was built without CGAL, which remeshing needs; build it with -D PLIANT_CGAL=ON");
}

}  // namespace pliant
#endif
