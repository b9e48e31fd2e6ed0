/// What is put into a material's vertex shader: positions and normals out of the tables of tables.js.
// SPDX-License-Identifier: MIT

const declarations = /* glsl */ `
uniform highp sampler2D reelCoefficients, reelBasis, reelFrames;
uniform int reelRows;
attribute vec2 reelRow; // of positions, of tangents
#ifdef REEL_CROWD
  uniform float reelTime, reelPeriod, reelDuration;
  uniform int reelFrameCount;
  attribute float reelPhase;
#else
  uniform ivec4 reelFrame;
  uniform vec4 reelWeight;
  uniform highp sampler2D reelBlend; // the basis at this time: mean, then x, y, z of four components, ...
  uniform ivec2 reelBlended; // where its coefficients begin, K / 4; 0: it is of several segments, to be mixed from the frames
#endif

#ifndef REEL_CROWD
  vec4 reelMixed( int i ) { return texelFetch( reelBlend, ivec2( i, 0 ), 0 ); }
#endif
vec4 reelTexel( highp sampler2D table, int i ) { return texelFetch( table, ivec2( i & 2047, i >> 11 ), 0 ); }

struct ReelMix { ivec4 frame; vec4 weight; };

#ifdef REEL_CROWD
  // src/timeline.js says the same.
  int reelNumber( int f ) { return ( f % reelFrameCount + reelFrameCount ) % reelFrameCount; }
  bool reelHas( int f ) { return reelPeriod > 0.0 || ( f >= 0 && f < reelFrameCount ); }
  float reelTimeOf( int f ) {
    int number = reelNumber( f );
    return reelTexel( reelFrames, 2 * number + 1 ).w + float( ( f - number ) / reelFrameCount ) * reelPeriod;
  }
  void reelAddSpeed( inout vec4 w, ivec4 p, float scale, float r, float s ) {
    if ( r > 0.0 ) {
      w[ p.x ] -= scale / ( r * ( 1.0 + r ) );
      w[ p.y ] += scale * ( 1.0 - r ) / r;
      w[ p.z ] += scale * r / ( 1.0 + r );
    } else if ( s > 0.0 ) {
      w[ p.y ] -= scale * ( 2.0 + s ) / ( 1.0 + s );
      w[ p.z ] += scale * ( 1.0 + s ) / s;
      w[ p.w ] -= scale / ( s * ( 1.0 + s ) );
    } else {
      w[ p.y ] -= scale;
      w[ p.z ] += scale;
    }
  }
  ReelMix reelMixAt( float t ) {
    int low = -1, high = reelFrameCount;
    while ( high - low > 1 ) {
      int middle = ( low + high ) / 2;
      if ( reelTimeOf( middle ) <= t ) low = middle; else high = middle;
    }
    vec4 one = vec4( 1.0, 0.0, 0.0, 0.0 );
    if ( low < 0 ) return ReelMix( ivec4( 0 ), one );
    if ( ! reelHas( low + 1 ) ) return ReelMix( ivec4( low ), one );
    float h = reelTimeOf( low + 1 ) - reelTimeOf( low ), u = ( t - reelTimeOf( low ) ) / h, v = 1.0 - u;
    float before = reelHas( low - 1 ) ? ( reelTimeOf( low ) - reelTimeOf( low - 1 ) ) / h : 0.0;
    float after = reelHas( low + 2 ) ? ( reelTimeOf( low + 2 ) - reelTimeOf( low + 1 ) ) / h : 0.0;
    vec4 w = vec4( 0.0, ( 1.0 + 2.0 * u ) * v * v, u * u * ( 3.0 - 2.0 * u ), 0.0 );
    reelAddSpeed( w, ivec4( 0, 1, 2, 3 ), u * v * v, before, after );
    reelAddSpeed( w, ivec4( 3, 2, 1, 0 ), u * u * v, after, before );
    if ( any( greaterThan( abs( w ), vec4( 16.0 ) ) ) ) w = vec4( 0.0, v, u, 0.0 );
    return ReelMix( ivec4( reelNumber( low - 1 ), reelNumber( low ), reelNumber( low + 1 ), reelNumber( low + 2 ) ), w );
  }
  ReelMix reelNow() {
    float t = reelTime + reelPhase;
    return reelMixAt( reelDuration > 0.0 ? t - floor( t / reelDuration ) * reelDuration : 0.0 );
  }
#else
  ReelMix reelNow() { return ReelMix( reelFrame, reelWeight ); }
#endif

// Rows of the coefficients: of the position, of the two tangents.
ivec3 reelRowsOf() {
  int tangents = reelRows + 2 * int( reelRow.y );
  return ivec3( int( reelRow.x ), tangents, tangents + 1 );
}
vec3 reelDots( vec4 c, vec4 x, vec4 y, vec4 z ) { return vec3( dot( c, x ), dot( c, y ), dot( c, z ) ); }

// The position in the first column; with tangents, those in the others.
void reelAddFour( inout mat3 sums, ivec3 at, vec4 x, vec4 y, vec4 z, bool tangents ) {
  sums[ 0 ] += reelDots( reelTexel( reelCoefficients, at.x ), x, y, z );
  if ( ! tangents ) return;
  sums[ 1 ] += reelDots( reelTexel( reelCoefficients, at.y ), x, y, z );
  sums[ 2 ] += reelDots( reelTexel( reelCoefficients, at.z ), x, y, z );
}

mat3 reelPose( bool tangents ) {
  mat3 sums = mat3( 0.0 );
  ivec3 rows = reelRowsOf();
  #ifndef REEL_CROWD
    if ( reelBlended.y > 0 ) {
      ivec3 at = reelBlended.x + rows * reelBlended.y;
      sums[ 0 ] = reelMixed( 0 ).xyz;
      for ( int k = 0; k < reelBlended.y; ++ k )
        reelAddFour( sums, at + k, reelMixed( 3 * k + 1 ), reelMixed( 3 * k + 2 ), reelMixed( 3 * k + 3 ), tangents );
      return sums;
    }
  #endif
  ReelMix now = reelNow();
  for ( int n = 0; n < 4; ++ n ) {
    float weight = now.weight[ n ];
    if ( weight == 0.0 ) continue;
    vec4 head = reelTexel( reelFrames, 2 * now.frame[ n ] );
    int fours = int( head.y ), basis = int( head.z );
    ivec3 at = int( head.x ) + ( int( head.w ) << 20 ) + rows * fours;
    mat3 part = mat3( 0.0 );
    part[ 0 ] = reelTexel( reelFrames, 2 * now.frame[ n ] + 1 ).xyz;
    for ( int k = 0; k < fours; ++ k )
      reelAddFour( part, at + k, reelTexel( reelBasis, basis + 3 * k ), reelTexel( reelBasis, basis + 3 * k + 1 ),
        reelTexel( reelBasis, basis + 3 * k + 2 ), tangents );
    sums += weight * part;
  }
  return sums;
}
`;

const normals = /* glsl */ `
#define REEL_POSED
mat3 reelPosed = reelPose( true );
vec3 reelAcross = cross( reelPosed[ 1 ], reelPosed[ 2 ] );
float reelArea = length( reelAcross );
vec3 objectNormal = reelArea > 1e-12 ? reelAcross / reelArea : vec3( normal );
#ifdef USE_TANGENT
  vec3 objectTangent = tangent.xyz - objectNormal * dot( tangent.xyz, objectNormal );
#endif
`;

const place = /* glsl */ `
#ifdef REEL_POSED
  transformed = reelPosed[ 0 ];
#else
  transformed = reelPose( false )[ 0 ];
#endif
`;

/// A three.js vertex shader that takes positions and normals from a reel.
export function reelVertexShader(shader) {
  return shader
    .replace('#include <common>', `#include <common>\n${declarations}`)
    .replace('#include <beginnormal_vertex>', normals)
    .replace('#include <begin_vertex>', `#include <begin_vertex>\n${place}`);
}
