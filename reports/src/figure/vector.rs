//! Plotters' backend for SVG, with the letters of the bundled font measured and set as in the bitmap.

use super::text;
use plotters::backend::SVGBackend;
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind,
    text_anchor::VPos,
};

/// [`SVGBackend`] with our metrics of text.
pub(super) struct Vector<'a>(pub(super) SVGBackend<'a>);

/// The document with its physical size, in inches, instead of units of the canvas.
pub(super) fn sized(document: &str, (width, height): (u32, u32)) -> String {
    let inches = |units: u32| f64::from(units) / (72.0 * text::POINT);
    let units = format!("width=\"{width}\" height=\"{height}\"");
    let size = format!(
        "role=\"img\" stroke-linejoin=\"round\" width=\"{}in\" height=\"{}in\"",
        inches(width),
        inches(height)
    );
    document.replacen(&units, &size, 1)
}

/// A call handed on to the backend of plotters.
macro_rules! forward {
    ($($name:ident $(<$($generic:ident: $bound:path),*>)? ($($argument:ident: $type:ty),*);)*) => {$(
        fn $name $(<$($generic: $bound),*>)? (&mut self, $($argument: $type),*) -> Done<Self> {
            self.0.$name($($argument),*)
        }
    )*};
}

type Done<B> = Result<(), DrawingErrorKind<<B as DrawingBackend>::ErrorType>>;

impl<'a> DrawingBackend for Vector<'a> {
    type ErrorType = <SVGBackend<'a> as DrawingBackend>::ErrorType;

    fn get_size(&self) -> (u32, u32) {
        self.0.get_size()
    }

    forward! {
        ensure_prepared();
        present();
        draw_pixel(point: BackendCoord, color: BackendColor);
        draw_line<S: BackendStyle>(from: BackendCoord, to: BackendCoord, style: &S);
        draw_rect<S: BackendStyle>(from: BackendCoord, to: BackendCoord, style: &S, fill: bool);
        draw_circle<S: BackendStyle>(centre: BackendCoord, radius: u32, style: &S, fill: bool);
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        path: I,
        style: &S,
    ) -> Done<Self> {
        self.0.draw_path(path, style)
    }

    fn fill_polygon<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        path: I,
        style: &S,
    ) -> Done<Self> {
        self.0.fill_polygon(path, style)
    }

    fn draw_text<S: BackendTextStyle>(
        &mut self,
        letters: &str,
        style: &S,
        (x, y): BackendCoord,
    ) -> Done<Self> {
        // Where the backend itself lets the baseline drop to, with letters x of 0.547 em.
        let drops = match style.anchor().v_pos {
            VPos::Top => 0.76,
            VPos::Center => 0.5 * 0.547,
            VPos::Bottom => -0.5 * 0.547,
        };
        let more = (text::drop(&style.anchor().v_pos) - drops) * text::em(style);
        let (sin, cos) = text::turn(&style.transform()).sin_cos();
        let moved = (x + (more * sin).round() as i32, y + (more * cos).round() as i32);
        self.0.draw_text(letters, style, moved)
    }

    fn estimate_text_size<S: BackendTextStyle>(
        &self,
        text: &str,
        style: &S,
    ) -> Result<(u32, u32), DrawingErrorKind<Self::ErrorType>> {
        Ok(text::extent(text, style))
    }
}
