//! The part of an address behind `?`: names with values. A name that nobody asks for is an error, so that none is without
//! effect in silence.

use std::collections::BTreeMap;
use std::str::FromStr;

use super::Problem;
use super::body::LISTED;

/// Names and values that have not been taken yet.
#[derive(Debug)]
pub(crate) struct Query(Vec<(String, String)>);

impl Query {
    /// Of the text behind `?`.
    pub(crate) fn of(text: Option<&str>) -> Query {
        Query(form_urlencoded::parse(text.unwrap_or_default().as_bytes()).into_owned().collect())
    }

    /// All values of a name.
    pub(crate) fn all(&mut self, name: &str) -> Vec<String> {
        self.0.extract_if(.., |(own, _)| own == name).map(|(_, value)| value).collect()
    }

    /// The value of a name; none where it is not there or empty.
    ///
    /// # Errors
    /// It stands there twice.
    pub(crate) fn one(&mut self, name: &str) -> Result<Option<String>, Problem> {
        Ok(self.stated(name)?.filter(|value| !value.is_empty()))
    }

    /// The value of a name, which may be empty.
    fn stated(&mut self, name: &str) -> Result<Option<String>, Problem> {
        let mut all = self.all(name);
        match all.len() {
            0 | 1 => Ok(all.pop()),
            _ => Err(Problem::request(format!("`{name}` stands there {} times", all.len()))),
        }
    }

    /// The value of a name that takes one of some words.
    ///
    /// # Errors
    /// It has another value, or stands there twice.
    pub(crate) fn among<T: Copy>(&mut self, name: &str, words: &[(&str, T)]) -> Result<Option<T>, Problem> {
        let Some(value) = self.stated(name)? else { return Ok(None) };
        let found = words.iter().find(|(word, _)| *word == value);
        let all = || words.iter().map(|(word, _)| *word).collect::<Vec<_>>().join(", ");
        let found = found.ok_or_else(|| Problem::request(format!("`{name}` is one of: {}", all())))?;
        Ok(Some(found.1))
    }

    /// The value of a name that takes a number.
    ///
    /// # Errors
    /// It is no such number, or stands there twice.
    pub(crate) fn number<T: FromStr>(&mut self, name: &str) -> Result<Option<T>, Problem> {
        let value = self.stated(name)?;
        let number = value.map(|value| value.parse().map_err(|_| value));
        number.transpose().map_err(|value| Problem::request(format!("`{name}` takes no `{value}`")))
    }

    /// Entries of a page of a list at most: `limit`.
    ///
    /// # Errors
    /// As of [`Query::number`].
    pub(crate) fn limit(&mut self) -> Result<u32, Problem> {
        let [usual, most] = LISTED;
        Ok(self.number("limit")?.unwrap_or(usual).clamp(1, most))
    }

    /// The values of a name, each a name and a value: `option=o_word=ignore`.
    ///
    /// # Errors
    /// One is not of this form, or has its name twice.
    pub(crate) fn pairs(&mut self, name: &str) -> Result<BTreeMap<String, String>, Problem> {
        let mut pairs = BTreeMap::new();
        for text in self.all(name) {
            let form = || Problem::request(format!("`{name}={text}` is not of the form {name}=NAME=VALUE"));
            let (own, value) = text.split_once('=').ok_or_else(form)?;
            if pairs.insert(own.to_owned(), value.to_owned()).is_some() {
                return Err(Problem::request(format!("`{own}` stands there twice")));
            }
        }
        Ok(pairs)
    }

    /// Nothing is left.
    ///
    /// # Errors
    /// A name that nobody has asked for.
    pub(crate) fn end(self, takes: &str) -> Result<(), Problem> {
        match self.0.first() {
            None => Ok(()),
            Some((name, _)) => {
                let takes =
                    if takes.is_empty() { "it takes none".to_owned() } else { format!("it takes: {takes}") };
                Err(Problem::request(format!("the address takes no `{name}`")).help(takes))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_name_is_taken_once_or_refused() {
        let mut query = Query::of(Some("dialect=mach9&option=a=1&option=b=x%3Dy&start=X-9%2CY1&left=over"));
        assert_eq!(query.one("dialect").expect("one").as_deref(), Some("mach9"));
        assert_eq!(query.one("start").expect("one").as_deref(), Some("X-9,Y1"));
        let pairs = query.pairs("option").expect("pairs");
        assert_eq!(
            pairs.into_iter().collect::<Vec<_>>(),
            [("a".into(), "1".into()), ("b".into(), "x=y".into())]
        );
        assert!(query.end("dialect").is_err());
        assert!(Query::of(Some("a=1&a=2")).one("a").is_err());
        assert!(Query::of(Some("a=x")).number::<u32>("a").is_err());
        assert!(Query::of(Some("a=")).number::<u32>("a").is_err());
        assert!(Query::of(Some("a=")).among("a", &[("y", ())]).is_err());
        assert!(Query::of(Some("a=x")).among("a", &[("y", ())]).is_err());
        assert!(Query::of(Some("option=a")).pairs("option").is_err());
        assert!(Query::of(None).end("").is_ok());
    }
}
