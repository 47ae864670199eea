// Second half of the edge smoothing (after Lottes' FXAA, 2009): blurs along the edge.
uniform sampler2D u_picture;
uniform vec2 u_pixel;  // one over the picture's size

out vec4 o_color;

float luma(vec3 c) { return dot(c, vec3(0.30, 0.59, 0.11)); }

vec3 filtered(vec2 at) { return textureLod(u_picture, at, 0.0).rgb; }

void main() {
  ivec2 p = ivec2(gl_FragCoord.xy);
  vec2 at = gl_FragCoord.xy * u_pixel;
  float m = luma(texelFetch(u_picture, p, 0).rgb);
  float nw = luma(texelFetchOffset(u_picture, p, 0, ivec2(-1, 1)).rgb);
  float ne = luma(texelFetchOffset(u_picture, p, 0, ivec2(1, 1)).rgb);
  float sw = luma(texelFetchOffset(u_picture, p, 0, ivec2(-1, -1)).rgb);
  float se = luma(texelFetchOffset(u_picture, p, 0, ivec2(1, -1)).rgb);
  float low = min(m, min(min(nw, ne), min(sw, se)));
  float high = max(m, max(max(nw, ne), max(sw, se)));
  // At right angles to the gradient (gx, gy): (-gy, gx).
  vec2 dir = vec2((sw + se) - (nw + ne), (ne + se) - (nw + sw));
  float damp = max((nw + ne + sw + se) * 0.03125, 1.0 / 128.0);
  dir = clamp(dir / (min(abs(dir.x), abs(dir.y)) + damp), -8.0, 8.0) * u_pixel;
  vec3 near = 0.5 * (filtered(at - dir / 6.0) + filtered(at + dir / 6.0));
  vec3 wide = 0.5 * near + 0.25 * (filtered(at - dir * 0.5) + filtered(at + dir * 0.5));
  float l = luma(wide);
  o_color = vec4(l < low || l > high ? near : wide, 1.0);
}
