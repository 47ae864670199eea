// Surfaces: bones, hulls, tool and marks. With COVERS: skin that bends with a knee, as LimbCover
// says (osteon/scene/limb_cover.h).
in vec3 a_position;
in vec3 a_normal;
in vec4 a_shade;

uniform mat4 u_view_from_model;
uniform mat4 u_clip_from_view;
uniform vec2 u_outline;  // half pixel sizes in clip units times the outline's width; 0: none

#ifdef COVERS
uniform vec4 u_cover_axis;    // unit; the lower bone's turn against the upper one, radians
uniform vec4 u_cover_point;   // of the axis; how far along it the lower bone has gone
uniform vec4 u_cover_plane;   // towards the lower bone; where both have half
uniform vec4 u_cover_front;   // forwards; there is the middle
uniform vec3 u_cover_halves;  // of the stretch between both: behind, in front; from where in front
uniform vec2 u_cover_reach;   // of a portal's skin: wholly to, changed from
uniform vec4 u_cover_wholes[4];  // places of portals
uniform vec4 u_cover_shares;     // of the lower bone there
uniform int u_cover_count;

// A smooth step's rise and, before it, how steep it is there.
vec2 rise(float from, float to, float x) {
  float t = clamp((x - from) / (to - from), 0.0, 1.0);
  return vec2(6.0 * t * (1.0 - t) / (to - from), t * t * (3.0 - 2.0 * t));
}

// The share of a place after its gradient.
vec4 cover_share(vec3 p) {
  vec2 front = rise(0.0, u_cover_halves.z, dot(u_cover_front.xyz, p) - u_cover_front.w);
  float wider = u_cover_halves.y - u_cover_halves.x;
  float width = u_cover_halves.x + wider * front.y;
  float across = (dot(u_cover_plane.xyz, p) - u_cover_plane.w) / width;
  vec2 along = rise(-1.0, 1.0, across);
  vec3 steeper = u_cover_plane.xyz - across * wider * front.x * u_cover_front.xyz;
  vec4 share = vec4(along.x / width * steeper, along.y);
  for (int k = 0; k < u_cover_count; ++k) {
    vec3 from = p - u_cover_wholes[k].xyz;
    float away = max(length(from), 1e-6);
    vec2 far = rise(u_cover_reach.x, u_cover_reach.y, away);
    float more = share.w - u_cover_shares[k];
    share = vec4(far.y * share.xyz + more * far.x * from / away, u_cover_shares[k] + far.y * more);
  }
  return share;
}

vec3 turned(vec3 v, float angle) {
  vec3 axis = u_cover_axis.xyz;
  return cos(angle) * v + sin(angle) * cross(axis, v) + (1.0 - cos(angle)) * dot(axis, v) * axis;
}
#endif

invariant gl_Position;  // depth is drawn by one program, light by another

out vec3 v_position;
out vec3 v_model;
out vec3 v_normal;
out vec4 v_shade;

void main() {
  vec3 place = a_position;
  vec3 out_of = a_normal;
#ifdef COVERS
  vec4 share = cover_share(a_position);
  float angle = share.w * u_cover_axis.w;
  vec3 arm = turned(a_position - u_cover_point.xyz, angle);
  place = u_cover_point.xyz + arm + share.w * u_cover_point.w * u_cover_axis.xyz;
  // Skin that is sheared: its normal goes with the inverse transpose of turn + onward (x) gradient
  // (Sherman and Morrison's formula); onward is where more of a share would take the place.
  vec3 onward = u_cover_axis.w * cross(u_cover_axis.xyz, arm) + u_cover_point.w * u_cover_axis.xyz;
  vec3 gradient = turned(share.xyz, angle);
  out_of = turned(a_normal, angle);
  out_of -= gradient * dot(onward, out_of) / max(1.0 + dot(onward, gradient), 0.1);
  out_of = normalize(out_of);
#endif
  vec4 position = u_view_from_model * vec4(place, 1.0);
  vec3 normal = mat3(u_view_from_model) * out_of;
  v_position = position.xyz;
  v_model = a_position;
  v_normal = normal;
  v_shade = a_shade;
  gl_Position = u_clip_from_view * position;
  gl_Position.xy += u_outline * normalize(normal.xy + vec2(1e-6)) * gl_Position.w;
}
