//! FUS-2: where a radar object stands in the camera's image, in integers.
//!
//! Radar axes: ahead, left, up, from the radar. Camera axes: right, down, ahead, from the camera. A point goes from
//! radar to camera axes (rotation in 1/2¹⁴, translation in cm), onto the image plane (pinhole), into pixels:
//! `u = u₀ + f·X/Z`. Edges are first `u·Z`, compared with the image at that depth, and then divided once by the depth
//! and kept in eighths of a pixel ([`STEPS`]), rounded down: the 512 comparisons that follow fit 32 bits and multiply
//! by no depth.
//!
//! A radar object is a point without a size. Its box is that of an upright rectangle of the configured size of the
//! camera object's class, which faces the camera and stands on the road below the point; true sizes differ, which
//! the threshold of the match allows for. Yaw and pitch of the camera move the box but do not slant it.
//!
//! The lateral offset of a radar object counts from the predicted path, which the projection takes for the bus's
//! axis: in a bend a match may fail, and the object then needs its updates to count (FUS-3c).
//!
//! # Invariants
//! Every product fits, whatever the objects *and* the configuration hold: each factor has 16 bits, a position in 1/2¹⁴
//! cm has 34 with its sign, a focal length times it 50, a reach 35. An edge is clipped to the image at its depth, 16 by
//! 16 bits. Only an image beyond 8191 px would saturate; its range ends at 4096.

use supervisor_core::{Config, DistanceCm, OffsetCm, Pixel, RotationQ14, Row};

use crate::scene::PixelBox;

/// Fraction bits of a rotation, and of a position.
const Q14: u32 = 14;
/// Edges of boxes are kept in eighths of a pixel ...
pub const STEPS: u16 = 1 << STEP_BITS;
/// ... which is three bits of a position times a focal length.
const STEP_BITS: u32 = 3;

/// Both edges of a box in one direction of the image, in 1/8 px.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
pub struct Span {
    /// The lesser: left, or upper.
    pub least: u16,
    /// The greater: right, or lower.
    pub most: u16,
}

/// The box of an object in the image: columns, rows.
pub type Outline = [Span; 2];

/// One direction of the image, its columns or its rows, and the part of the calibration that belongs to it.
#[derive(Clone, Copy, Debug)]
struct Axis {
    /// What a cm ahead, left and up adds to the position in this direction, and the translation.
    row: [RotationQ14; 3],
    shift: OffsetCm,
    /// In px.
    focal: u16,
    /// Principal point and length of the image, in 1/8 px.
    principal: u16,
    image: u16,
}

/// How far a box reaches from the point it stands on, focal length times size, in 1/8 px · cm.
#[derive(Clone, Copy, Debug)]
struct Reach {
    before: i64,
    behind: i64,
}

/// The size of a class as the camera sees it, in columns and rows.
#[derive(Clone, Copy, Debug)]
pub struct Size([Reach; 2]);

/// Where a radar object stands on the road, in the image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Foot {
    /// How far ahead of the camera, in cm, rounded down.
    depth: u16,
    /// Column and row times depth, in 1/8 px · cm.
    point: [i64; 2],
}

/// The calibration, ready for use.
#[derive(Clone, Copy, Debug)]
pub struct Lens {
    across: Axis,
    down: Axis,
    ahead: [RotationQ14; 3],
    ahead_shift: OffsetCm,
    height: DistanceCm,
    range: u16,
}

/// Pixels, or steps, times length: 16 bits each.
fn product(pixels: u16, length: u16) -> u32 {
    u32::from(pixels).saturating_mul(u32::from(length))
}

impl Axis {
    /// The edges of a box in this direction, clipped to the image as the camera's box is.
    fn edges(&self, point: i64, Reach { before, behind }: Reach, depth: u16) -> Span {
        let image = product(self.image, depth);
        let edge = |at: i64| {
            let inside = u32::try_from(at.clamp(0, image.into())).unwrap_or(u32::MAX);
            inside.checked_div(depth.into()).and_then(|steps| u16::try_from(steps).ok()).unwrap_or(u16::MAX)
        };
        Span { least: edge(point.saturating_sub(before)), most: edge(point.saturating_add(behind)) }
    }
    /// A span of pixels, clipped to the image.
    fn span(&self, least: u16, length: u16) -> Span {
        let edge = |at: u16| at.saturating_mul(STEPS).min(self.image);
        Span { least: edge(least), most: edge(least.saturating_add(length)) }
    }
}

impl Lens {
    /// The camera of this configuration.
    #[must_use]
    pub fn of(config: &Config) -> Self {
        let [r0, r1, r2, d0, d1, d2, a0, a1, a2] = config.camera_rotation.0;
        let [right, down, ahead] = config.camera_translation.0;
        let axis = |row, shift, focal: Pixel, principal: Pixel, image: Pixel| Axis {
            row,
            shift,
            focal: focal.raw(),
            principal: principal.raw().saturating_mul(STEPS),
            image: image.raw().saturating_mul(STEPS),
        };
        let ([focal_x, focal_y], [column, row]) = (config.focal_length.0, config.principal_point.0);
        let [columns, rows] = config.image_size.0;
        Self {
            across: axis([r0, r1, r2], right, focal_x, column, columns),
            down: axis([d0, d1, d2], down, focal_y, row, rows),
            ahead: [a0, a1, a2],
            ahead_shift: ahead,
            height: config.radar_height,
            range: config.match_range.raw(),
        }
    }

    /// The size of a class: half to the left and to the right of its foot, and upwards of it.
    #[must_use]
    pub fn size(&self, Row([width, height]): Row<DistanceCm, 2>) -> Size {
        let steps = |pixels: u32| i64::from(pixels).saturating_mul(STEPS.into());
        let half = steps(product(self.across.focal, width.raw())) / 2;
        let tall = steps(product(self.down.focal, height.raw()));
        Size([Reach { before: half, behind: half }, Reach { before: tall, behind: 0 }])
    }

    /// The foot's position along one camera axis, in 1/2¹⁴ cm: three products of 32 bits, one of 30.
    fn position(&self, [x, y, z]: [RotationQ14; 3], shift: OffsetCm, distance: DistanceCm, offset: OffsetCm) -> i64 {
        let ahead = i64::from(x.raw()).saturating_mul(distance.raw().into());
        let left = i64::from(y.raw()).saturating_mul(offset.raw().into());
        let below = i64::from(z.raw()).saturating_mul(self.height.raw().into());
        let shift = i64::from(shift.raw()).saturating_mul(1 << Q14);
        ahead.saturating_add(left).saturating_sub(below).saturating_add(shift)
    }

    /// FUS-2a: where on the image a radar object stands. `None` behind the camera, in its plane, and beyond the range
    /// of matching: no box.
    #[must_use]
    pub fn foot(&self, distance: DistanceCm, offset: OffsetCm) -> Option<Foot> {
        let depth = self.position(self.ahead, self.ahead_shift, distance, offset) >> Q14;
        let depth = u16::try_from(depth).ok().filter(|depth| *depth > 0 && *depth <= self.range)?;
        let point = |axis: &Axis| {
            let position = self.position(axis.row, axis.shift, distance, offset);
            let from_centre = position.saturating_mul(axis.focal.into()) >> Q14.saturating_sub(STEP_BITS);
            from_centre.saturating_add(product(axis.principal, depth).into())
        };
        Some(Foot { depth, point: [point(&self.across), point(&self.down)] })
    }

    /// FUS-2a: the box of a radar object that stands there and has this size.
    #[must_use]
    pub fn outline(&self, Foot { depth, point: [column, row] }: Foot, Size([width, height]): Size) -> Outline {
        [self.across.edges(column, width, depth), self.down.edges(row, height, depth)]
    }

    /// The camera's box by its edges, clipped to the image.
    #[must_use]
    pub fn seen(&self, PixelBox { left, top, width, height }: PixelBox) -> Outline {
        [self.across.span(left, width), self.down.span(top, height)]
    }
}
