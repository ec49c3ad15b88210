//! Pages as HTML: readable on a telephone and in the dark, with contents, and with data folded away.

use super::{About, Item, Page, QUICK, Section, links};
use crate::markup::{escaped, inline};

const STYLE: &str = "
:root{color-scheme:light dark;--ink:#1b1b1b;--soft:#5a5a5a;--paper:#fff;--tint:#f3f4f6;--line:#d8dade;--link:#0b57a4}
@media(prefers-color-scheme:dark){:root{--ink:#e6e6e6;--soft:#a9adb3;--paper:#16181b;--tint:#23262b;--line:#3c4047;--link:#82b7ee}}
*{box-sizing:border-box}
body{font:16px/1.55 system-ui,sans-serif;max-width:64rem;margin:0 auto;padding:1.5rem 1rem 5rem;color:var(--ink);background:var(--paper);overflow-wrap:break-word}
a{color:var(--link)}
h1{font-size:1.7rem;line-height:1.25;margin:.5rem 0}
h2{font-size:1.3rem;line-height:1.3;margin-top:3rem;padding-bottom:.2rem;border-bottom:1px solid var(--line)}
h2 a.up{float:right;font-size:.85rem;font-weight:400}
.about,.files,summary{color:var(--soft);font-size:.9rem}
.quick{background:var(--tint);border-left:4px solid #d55e00;padding:.5rem .8rem}
nav ol{columns:2 20rem;padding-left:1.4rem}
figure{margin:1.6rem 0}
img{max-width:100%;height:auto;background:#fff}
figcaption p,.caption{margin:.4rem 0}
.scroll{overflow-x:auto;margin:.5rem 0}
table{border-collapse:collapse;font-variant-numeric:tabular-nums;font-size:.92rem}
th,td{padding:.2rem .7rem;text-align:left;border-bottom:1px solid var(--line)}
th{border-bottom:2px solid var(--soft)}
.number{text-align:right}
code{background:var(--tint);padding:.05rem .3rem;border-radius:3px;overflow-wrap:anywhere}
summary{cursor:pointer}
.paper{border-top:1px solid var(--line);padding:1rem 0}
.paper img{float:right;width:17rem;max-width:45%;margin:0 0 .5rem 1.5rem}
.paper::after{content:'';display:block;clear:both}
@media(max-width:34rem){body{padding:1rem .7rem 4rem}.paper img{float:none;width:100%;max-width:100%;margin:0}h2 a.up{float:none;display:block}}
@media print{nav,a.up,details{display:none}h2{break-after:avoid}figure,table{break-inside:avoid}}
";

fn document(title: &str, body: &str) -> String {
    let title = escaped(title);
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>{title}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n{body}</body>\n</html>\n"
    )
}

/// What a place on a page is called in links: letters and digits of its title.
fn anchor(title: &str) -> String {
    let letters = title.chars().map(|c| if c.is_alphanumeric() { c } else { '-' });
    let words: String = letters.flat_map(char::to_lowercase).collect();
    words.split('-').filter(|word| !word.is_empty()).collect::<Vec<_>>().join("-")
}

fn source(about: &About) -> String {
    let doi = about.paper.doi.as_ref().map_or_else(String::new, |doi| {
        format!(" <a href=\"https://doi.org/{doi}\">doi:{}</a>", escaped(doi))
    });
    format!("{}.{doi}", inline(&about.paper.citation))
}

fn made(about: &About) -> String {
    format!(
        "Made by courant {} on {} with <code>{}</code>.",
        env!("CARGO_PKG_VERSION"),
        escaped(&about.date),
        escaped(&about.command)
    )
}

fn warning(about: &About) -> String {
    match about.is_quick {
        true => format!("<p class=\"quick\"><strong>A quick look.</strong> {QUICK}</p>\n"),
        false => String::new(),
    }
}

/// The page.
pub(super) fn page(page: &Page) -> String {
    let about = &page.about;
    let contents: String = page
        .sections
        .iter()
        .map(|s| format!("<li><a href=\"#{}\">{}</a></li>\n", anchor(&s.title), inline(&s.title)))
        .collect();
    let way_back = match about.is_one_of_several {
        true => "<p><a href=\"../index.html\">← all reports</a></p>\n",
        false => "",
    };
    let mut body = format!(
        "<header id=\"top\">\n{way_back}<h1>{}</h1>\n<p class=\"about\">{}<br>{}</p>\n{}</header>\n\
         <nav aria-label=\"Contents\"><h2>Contents</h2>\n<ol>\n{contents}</ol></nav>\n<main>\n",
        inline(&about.paper.title),
        source(about),
        made(about),
        warning(about)
    );
    page.sections.iter().for_each(|section| body.push_str(&self::section(section)));
    document(&about.paper.title, &(body + "</main>\n"))
}

fn section(section: &Section) -> String {
    let mut text = format!(
        "<section id=\"{}\">\n<h2><a class=\"up\" href=\"#top\">contents ↑</a>{}</h2>\n",
        anchor(&section.title),
        inline(&section.title)
    );
    for item in &section.items {
        let folded = links(item)
            .into_iter()
            .map(|(label, file)| format!("<a href=\"{file}\">{}</a>", escaped(&label)))
            .collect::<Vec<_>>()
            .join(", ");
        text.push_str(&match item {
            Item::Paragraph(paragraph) => format!("<p>{}</p>\n", inline(paragraph)),
            Item::Table { name, table, command } => format!(
                "<div id=\"{name}\">\n<p class=\"caption\"><strong>{}</strong></p>\n\
                 <div class=\"scroll\" tabindex=\"0\">{}</div>\n{}</div>\n",
                inline(table.caption()),
                table.to_html(),
                details(&folded, command)
            ),
            Item::Figure { name, caption, command, .. } => {
                // What is heard instead of a picture is short.
                let seen = caption.split(". ").take(2).collect::<Vec<_>>().join(". ");
                format!(
                    "<figure id=\"{name}\">\n<a href=\"{name}.svg\"><img src=\"{name}.png\" loading=\"lazy\" alt=\"{}\"></a>\n\
                     <figcaption><p>{}</p></figcaption>\n{}</figure>\n",
                    escaped(&seen.replace(['`', '_'], " ")),
                    inline(caption),
                    details(&folded, command)
                )
            }
        });
    }
    text + "</section>\n"
}

fn details(files: &str, command: &str) -> String {
    format!(
        "<details><summary>Data, and how it is made again</summary>\n<p class=\"files\">{files}. \
         <code>{}</code></p></details>\n",
        escaped(command)
    )
}

/// The page that leads to several.
pub(super) fn index(title: &str, pages: &[Page]) -> String {
    let mut body = format!("<header>\n<h1>{}</h1>\n", escaped(title));
    body.push_str(
        "<p>Two papers on particle methods for gas dynamics, computed again: every table and figure, the proved limits of \
         their time steps, and what the papers say set against numbers. Each picture leads to its data and to the command \
         that makes it again.</p>\n",
    );
    if let Some(page) = pages.first() {
        let date = escaped(&page.about.date);
        let version = env!("CARGO_PKG_VERSION");
        body.push_str(&format!(
            "<p class=\"about\">courant {version}, {date}</p>\n{}",
            warning(&page.about)
        ));
    }
    body.push_str("</header>\n<main>\n");
    for page in pages {
        let place = &page.about.paper.name;
        let names = |item: &Item| match item {
            Item::Figure { name, .. } => Some(name.clone()),
            _ => None,
        };
        let first = page.sections.iter().flat_map(|section| &section.items).find_map(names);
        let picture = first.map_or_else(String::new, |name| {
            format!("<a href=\"{place}/index.html#{name}\"><img src=\"{place}/{name}.png\" alt=\"\"></a>\n")
        });
        let parts: String = page
            .sections
            .iter()
            .map(|s| {
                format!(
                    "<li><a href=\"{place}/index.html#{}\">{}</a></li>\n",
                    anchor(&s.title),
                    inline(&s.title)
                )
            })
            .collect();
        body.push_str(&format!(
            "<section class=\"paper\">\n{picture}<h2><a href=\"{place}/index.html\">{}</a></h2>\n\
             <p class=\"about\">{}</p>\n<p>{}</p>\n<details open><summary>What is in it</summary>\n<ol>\n{parts}</ol></details>\n</section>\n",
            inline(&page.about.paper.title),
            source(&page.about),
            inline(&page.about.paper.summary)
        ));
    }
    document(title, &(body + "</main>\n"))
}
