//! Cha & Whitworth 2003.
