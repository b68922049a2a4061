#include "plugin/open.hpp"

#include "exec/floating_point.hpp"
#include "plugin/decorated_tables.hpp"
#include "plugin/world.hpp"
#include "plumb/backend.hpp"

namespace plumb::impulse {

PlumbResult open(const PlumbOpenRequest* request, PlumbOpenReply* reply) {
  const PlumbResult result = backend::open<World>(request, reply);
  if (result >= 0) reply->table = DecoratedTables<FloatingPointScope>::of(*reply->table);
  return result;
}

}  // namespace plumb::impulse
