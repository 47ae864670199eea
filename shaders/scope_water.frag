// The water on the way to what a scope's flat picture shows: how thick it is there, 1 on the mean,
// and the light that plumes of blood take, as a power of e. Both change slowly over the picture, so
// half as many pixels tell them.
in vec2 v_at;

uniform sampler2D u_flat;      // linear light and distance, as a pinhole sees it
uniform float u_flat_half;     // tangent of the flat picture's half width
uniform sampler3D u_clouds;    // of water, repeated
uniform float u_clouds_per_m;  // how often they are repeated
uniform int u_plumes;          // how many
uniform vec3 u_plume_at[6];    // in World
uniform vec2 u_plume_size[6];  // radius, and light that its middle takes, each metre
uniform mat4 u_world_from_view;

out vec4 o_water;

// Smooth values 0..1, one change a unit.
float noise(vec3 p) {
  vec3 i = floor(p), f = fract(p);
  f = f * f * (3.0 - 2.0 * f);
  vec3 u = fract(i * vec3(0.1031, 0.1030, 0.0973));
  vec3 w = fract((i + 1.0) * vec3(0.1031, 0.1030, 0.0973));
  // Of hash(): the dot product over x and y by corner, over z, and what stands beside them.
  vec4 x = vec4(u.x, w.x, u.x, w.x), y = vec4(u.y, u.y, w.y, w.y);
  vec4 s = x + y, d = 2.0 * x * y + 33.33 * s;
  vec2 z = vec2(u.z, w.z), e = z * (z + 33.33);
  vec4 t = s + 2.0 * d;
  vec4 lo = fract((t + 2.0 * e.x) * (d + (z.x + e.x)));
  vec4 hi = fract((t + 2.0 * e.y) * (d + (z.y + e.y)));
  vec4 m = mix(lo, hi, f.z);
  vec2 n = mix(m.xy, m.zw, f.y);
  return mix(n.x, n.y, f.x);
}

// How thick the water is at a place of World, 1 on the mean.
float clouds(vec3 p) { return 2.0 * texture(u_clouds, p * u_clouds_per_m).r; }

// Light that plumes of blood take on the way, as a power of e: each falls off from its middle as a
// bell, whose sum along a line is known (tanh stands for the error function).
float plumes_on(vec3 eye, vec3 along, float distance_m) {
  float sum = 0.0;
  for (int k = 0; k < u_plumes; ++k) {
    vec3 to = u_plume_at[k] - eye;
    float s = u_plume_size[k].x, t = dot(to, along), off = dot(to, to) - t * t;
    // Half of each: tanh(x) = 1 - 2 / (1 + exp(2 x)).
    float part = 1.0 - 1.0 / (1.0 + exp(1.697 * (distance_m - t) / s)) - 1.0 / (1.0 + exp(1.697 * t / s));
    float wisps = 0.4 + 1.2 * noise(eye * 300.0 + (t + 0.3 * s) * along * 300.0 + 5.0 * float(k));
    sum += u_plume_size[k].y * 2.5066 * s * exp(-0.5 * off / (s * s)) * max(part, 0.0) * wisps;
  }
  return sum;
}

void main() {
  float distance_m = max(texture(u_flat, v_at).a, 1e-3);
  vec3 dir_C = normalize(vec3((2.0 * v_at - 1.0) * u_flat_half, -1.0));
  vec3 eye = u_world_from_view[3].xyz, along = mat3(u_world_from_view) * dir_C;
  float thick = 0.0;
  for (int k = 0; k < 2; ++k) thick += 0.5 * clouds(eye + (0.25 + 0.5 * float(k)) * distance_m * along);
  o_water = vec4(thick, plumes_on(eye, along, distance_m), 0.0, 1.0);
}
