// Put before the text of a surface's shader that leaves out what has changed (see ChangedCubes).
#define CHANGED

uniform sampler3D u_changed;       // of each cube of a grid: whether it shows another surface now
uniform mat4 u_changed_grid;       // from Model to the grid's own frame
uniform vec4 u_changed_from;       // lowest corner of the grid in that, and the side of a cube
uniform float u_changed_overlap;   // nearer than this to a cube that has not changed nothing is left out

bool is_changed(vec3 place) {
  ivec3 at = ivec3(floor((place - u_changed_from.xyz) / u_changed_from.w));
  ivec3 count = textureSize(u_changed, 0);
  if (any(lessThan(at, ivec3(0))) || any(greaterThanEqual(at, count))) return false;
  return texelFetch(u_changed, at, 0).r > 0.5;
}

bool is_left_out(vec3 model) {
  vec3 place = (u_changed_grid * vec4(model, 1.0)).xyz;
  for (int k = 0; k < 8; ++k) {
    vec3 corner = 2.0 * vec3(k & 1, (k >> 1) & 1, k >> 2) - 1.0;
    if (!is_changed(place + u_changed_overlap * corner)) return false;
  }
  return true;
}
